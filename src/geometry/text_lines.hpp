// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string_view>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

/// Text as lines of words, for checks of mesh files; errors name file and line.
class TextLines {
 public:
  /// File and text must outlive this. Comments begin with '#'.
  TextLines(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {
    if (text.starts_with("\xef\xbb\xbf")) position_ = 3;  // byte-order mark
  }

  /// Goes to the next line that holds a word; false at the end of the text.
  bool next() {
    while (position_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      rest_ = text_.substr(position_, end - position_);
      rest_ = rest_.substr(0, rest_.find('#'));
      position_ = end + 1;
      ++line_;
      rest_ = rest_.substr(0, rest_.find_last_not_of(" \t\r\v\f") + 1);
      skip_blanks();
      if (!rest_.empty()) return true;
    }
    rest_ = {};
    return false;
  }

  /// The next word of the line; empty at its end. A backslash at the end of a line joins the next one.
  std::string_view word() {
    skip_blanks();
    while (rest_ == "\\" && next()) {
    }
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\v\f"));
    rest_.remove_prefix(word.size());
    return word;
  }

  double number(std::string_view what) {
    std::string_view text = word();
    if (text.empty()) fail_here("the line ends where {} was expected; the file may be cut off", what);
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::invalid_argument || end != text.data() + text.size())
      fail_here("found \"{}\" where {} was expected; mend the line", shown(text), what);
    if (error == std::errc::result_out_of_range && text.find("e-") == std::string_view::npos &&
        text.find("E-") == std::string_view::npos)
      fail_here("{} is {}, too large for a number; mend the line", what, shown(text));
    if (std::isfinite(value) && std::abs(value) > std::numeric_limits<float>::max())
      fail_here("{} is {}, too large for a number; mend the line", what, shown(text));
    if (!std::isfinite(value))
      fail_here("{} is {}, expected a finite number; mend the line", what, shown(text));
    return value;
  }

  /// A number, or the word nan in any case and with any sign: what a sensor did not see.
  double number_or_nan(std::string_view what) {
    TextLines ahead = *this;
    std::string_view text = ahead.word();
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    const auto is = [&](std::size_t k, char letter) { return (text[k] | 0x20) == letter; };
    if (text.size() != 3 || !is(0, 'n') || !is(1, 'a') || !is(2, 'n')) return number(what);
    word();
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::int64_t integer(std::string_view what) {
    const std::string_view text = word();
    if (text.empty()) fail_here("the line ends where {} was expected; the file may be cut off", what);
    return integer_of(text, what);
  }

  /// The whole of a word as an integer.
  std::int64_t integer_of(std::string_view text, std::string_view what) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail_here("found \"{}\" where {} was expected; mend the line", shown(text), what);
    return value;
  }

  template <typename... Args>
  [[noreturn]] void fail_here(fmt::format_string<Args...> format, Args&&... args) const {
    fail_at(file_, line_, format, std::forward<Args>(args)...);
  }

  /// A piece of the file, safe to print in a sentence.
  static std::string shown(std::string_view text) {
    std::string result(text.substr(0, 40));
    for (char& c : result)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
    return text.size() > 40 ? result + "..." : result;
  }

  int line() const { return line_; }
  const std::filesystem::path& file() const { return file_; }
  /// Bytes that the lines before this one and this one take.
  std::size_t position() const { return std::min(position_, text_.size()); }

 private:
  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\v\f"), rest_.size())); }

  const std::filesystem::path& file_;
  std::string_view text_;
  std::string_view rest_;
  std::size_t position_ = 0;
  int line_ = 0;
};

}  // namespace eigengrasp
