// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// An element of an XML file that knows its file, so that every complaint says file and line. All readers
/// throw Error for values that are missing, malformed or not finite.
class XmlElement {
 public:
  XmlElement() = default;
  XmlElement(const std::filesystem::path* file, const tinyxml2::XMLElement* element)
      : file_(file), element_(element) {}

  explicit operator bool() const { return element_ != nullptr; }
  const std::filesystem::path& file() const { return *file_; }
  int line() const { return element_->GetLineNum(); }
  std::string name() const { return element_->Name(); }

  /// First child of that name; empty where there is none.
  XmlElement child(const char* child_name) const;
  XmlElement require_child(const char* child_name) const;
  /// All children, or those of one name, in their order.
  std::vector<XmlElement> children(const char* child_name = nullptr) const;

  /// Text of the element without white space around it.
  std::string text() const;
  std::string require_text() const;
  double number() const;
  int integer() const;
  /// Numbers of the text. @throws Error unless there are exactly `count` (any number for count < 0).
  std::vector<double> numbers(int count) const;
  Vec3 vector() const;

  std::vector<std::string> attribute_names() const;
  std::optional<std::string> attribute(const char* attribute_name) const;
  std::string require_attribute(const char* attribute_name) const;
  double require_attribute_number(const char* attribute_name) const;
  double attribute_number(const char* attribute_name, double otherwise) const;
  Vec3 require_attribute_vector(const char* attribute_name) const;
  Vec3 attribute_vector(const char* attribute_name, const Vec3& otherwise) const;

  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    fail_at(*file_, line(), format, std::forward<Args>(args)...);
  }

 private:
  const std::filesystem::path* file_ = nullptr;
  const tinyxml2::XMLElement* element_ = nullptr;
};

/// A parsed XML file. Its elements live as long as it does.
class XmlFile {
 public:
  /// @throws Error where the file cannot be read or is not well-formed, with the line.
  explicit XmlFile(std::filesystem::path file);
  XmlFile(const XmlFile&) = delete;
  XmlFile& operator=(const XmlFile&) = delete;

  XmlElement root() const { return XmlElement(&file_, document_.RootElement()); }
  /// The root. @throws Error unless it has that name.
  XmlElement require_root(const char* root_name) const;

 private:
  std::filesystem::path file_;
  tinyxml2::XMLDocument document_;
};

}  // namespace eigengrasp
