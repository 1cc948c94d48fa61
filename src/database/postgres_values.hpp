// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "database/sql_connection.hpp"

namespace eigengrasp {

/// Numbers in PostgreSQL's binary form: most significant byte first. As COPY ... BINARY reads them.
class PostgresWriter {
 public:
  void int16(std::int16_t v) { big_endian(static_cast<std::uint16_t>(v)); }
  void int32(std::int32_t v) { big_endian(static_cast<std::uint32_t>(v)); }
  void number(double v) { big_endian(std::bit_cast<std::uint64_t>(v)); }
  void raw(std::string_view bytes) { bytes_.append(bytes); }

  // Fields: the length, then the value.
  void int32_field(std::int64_t v) {
    int32(4);
    int32(static_cast<std::int32_t>(v));
  }
  void number_field(double v) {
    int32(8);
    number(v);
  }
  void bytes_field(std::string_view bytes) {
    int32(static_cast<std::int32_t>(bytes.size()));
    raw(bytes);
  }
  /// double precision[], from element 1 on
  void numbers_field(std::span<const double> numbers) {
    const auto n = static_cast<std::int32_t>(numbers.size());
    int32(n == 0 ? 12 : 20 + 12 * n);
    int32(n == 0 ? 0 : 1);  // dimensions
    int32(0);               // no nulls
    int32(701);             // float8
    if (n == 0) return;
    int32(n);
    int32(1);
    for (const double v : numbers) number_field(v);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  void big_endian(T v) {
    char out[sizeof v];
    for (std::size_t i = 0; i < sizeof v; ++i) out[i] = static_cast<char>(v >> 8 * (sizeof v - 1 - i));
    bytes_.append(out, sizeof v);
  }
  std::string bytes_;
};

/// A whole number of 1 to 8 bytes, most significant first.
inline std::uint64_t read_big_endian(std::string_view bytes) {
  std::uint64_t v = 0;
  for (const char c : bytes) v = v << 8 | static_cast<unsigned char>(c);
  return v;
}

}  // namespace eigengrasp
