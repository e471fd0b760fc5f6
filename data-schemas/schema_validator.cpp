// SPDX-License-Identifier: BSD-3-Clause
// The only file that includes valijson, which takes seconds to compile.
#include "data-schemas/schema_validator.hpp"

#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "brdf/error.hpp"

namespace gonio {
namespace {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

nlohmann::json converted(const Json& value) {
  if (value.is_bool()) return value.boolean();
  if (value.is_integer()) return value.integer();
  if (value.is_number()) {
    constexpr double exact = 9007199254740992.0;  // 2^53; draft 6 and later: a number without a fraction is an integer
    const double number = value.number();
    if (std::trunc(number) == number && std::abs(number) <= exact) return static_cast<std::int64_t>(number);
    return number;
  }
  if (value.is_string()) return value.string();
  if (value.is_array()) {
    nlohmann::json array = nlohmann::json::array();
    for (const Json& element : value.elements()) array.push_back(converted(element));
    return array;
  }
  if (value.is_object()) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [name, member] : value.members()) object[name] = converted(member);
    return object;
  }
  return nullptr;
}

}  // namespace

struct SchemaValidator::Compiled {
  valijson::Schema schema;
};

SchemaValidator::SchemaValidator(const Json& schema) : compiled_(std::make_unique<Compiled>()) {
  try {
    const nlohmann::json document = converted(schema);
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(document), compiled_->schema);
  } catch (const std::exception& error) {
    throw Error(ErrorKind::internal, {"JSON Schema", error.what(), "a schema of draft 7"});
  }
}
SchemaValidator::~SchemaValidator() = default;
SchemaValidator::SchemaValidator(SchemaValidator&&) noexcept = default;

bool SchemaValidator::accepts(const Json& value) const {
  // libstdc++ fills a table of std::ctype without a lock when a std::regex is made (locale_facets.h, narrow): a data race.
  static std::mutex one_at_a_time;
  const nlohmann::json document = converted(value);
  const std::lock_guard lock(one_at_a_time);
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  return validator.validate(compiled_->schema, Adapter(document), nullptr);
}

}  // namespace gonio
