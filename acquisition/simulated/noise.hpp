// SPDX-License-Identifier: BSD-3-Clause
// Noise that depends on what is read, never on when or in which order.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace gonio::acquisition::simulated {

/// A counter-based hash: every key word is mixed in turn by the finaliser of SplitMix64 (Steele, Lea & Flood, "Fast splittable
/// pseudorandom number generators", OOPSLA 2014).
std::uint64_t hash(std::initializer_list<std::uint64_t> key) noexcept;

/// A deviate of the standard normal distribution belonging to the key, by Box and Muller (Ann. Math. Stat. 29, 1958).
/// The same key always gives the same deviate, so a resumed run reads what an uninterrupted one would.
double normal_deviate(std::initializer_list<std::uint64_t> key) noexcept;

}  // namespace gonio::acquisition::simulated
