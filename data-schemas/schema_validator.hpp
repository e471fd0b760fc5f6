// SPDX-License-Identifier: BSD-3-Clause
// Does a value meet a schema: yes or no.
#pragma once

#include <memory>

#include "data-schemas/json.hpp"

namespace gonio {

/// A JSON Schema (draft 7, no references, see expanded_schema), made ready once and asked often. Types are strict: "1" is no number;
/// 1.0 is an integer.
class SchemaValidator {
 public:
  explicit SchemaValidator(const Json& schema);  ///< Error(internal) if it is no schema
  ~SchemaValidator();
  SchemaValidator(SchemaValidator&&) noexcept;

  /// May be called from several threads; they take turns.
  bool accepts(const Json& value) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace gonio
