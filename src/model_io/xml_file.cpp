// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/xml_file.hpp"

#include "eigengrasp/core/files.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

XmlElement XmlElement::child(const char* child_name) const {
  return XmlElement(file_, element_->FirstChildElement(child_name));
}

XmlElement XmlElement::require_child(const char* child_name) const {
  const XmlElement found = child(child_name);
  if (!found) fail("<{}> has no <{}>, expected one", name(), child_name);
  return found;
}

std::vector<XmlElement> XmlElement::children(const char* child_name) const {
  std::vector<XmlElement> found;
  for (auto* e = element_->FirstChildElement(child_name); e; e = e->NextSiblingElement(child_name))
    found.emplace_back(file_, e);
  return found;
}

std::string XmlElement::text() const {
  const char* content = element_->GetText();
  return std::string(trimmed(content ? content : ""));
}

std::string XmlElement::require_text() const {
  std::string content = text();
  if (content.empty()) fail("<{}> is empty, expected a value", name());
  return content;
}

double XmlElement::number() const {
  const auto value = parse_number(text());
  if (!value) fail("<{}> is \"{}\", expected a number", name(), shown(text()));
  return *value;
}

int XmlElement::integer() const {
  const auto value = parse_integer(text());
  if (!value) fail("<{}> is \"{}\", expected a whole number", name(), shown(text()));
  return *value;
}

std::vector<double> XmlElement::numbers(int count) const {
  const auto values = parse_numbers(text());
  if (!values || (count >= 0 && values->size() != static_cast<std::size_t>(count))) {
    const std::string expected = count >= 0 ? fmt::format("{} numbers", count) : "numbers";
    fail("<{}> is \"{}\", expected {}", name(), shown(text()), expected);
  }
  return *values;
}

Vec3 XmlElement::vector() const {
  const auto v = numbers(3);
  return Vec3(v[0], v[1], v[2]);
}

std::vector<std::string> XmlElement::attribute_names() const {
  std::vector<std::string> names;
  for (auto* a = element_->FirstAttribute(); a; a = a->Next()) names.emplace_back(a->Name());
  return names;
}

std::optional<std::string> XmlElement::attribute(const char* attribute_name) const {
  const char* value = element_->Attribute(attribute_name);
  if (!value) return std::nullopt;
  return std::string(trimmed(value));
}

std::string XmlElement::require_attribute(const char* attribute_name) const {
  const auto value = attribute(attribute_name);
  if (!value) fail("<{}> has no attribute {}, expected one", name(), attribute_name);
  if (value->empty()) fail("<{}>: the attribute {} is empty, expected a value", name(), attribute_name);
  return *value;
}

double XmlElement::require_attribute_number(const char* attribute_name) const {
  const std::string value = require_attribute(attribute_name);
  const auto number = parse_number(value);
  if (!number) fail("<{}>: {} is \"{}\", expected a number", name(), attribute_name, shown(value));
  return *number;
}

double XmlElement::attribute_number(const char* attribute_name, double otherwise) const {
  return attribute(attribute_name) ? require_attribute_number(attribute_name) : otherwise;
}

Vec3 XmlElement::require_attribute_vector(const char* attribute_name) const {
  const std::string value = require_attribute(attribute_name);
  const auto v = parse_numbers(value);
  if (!v || v->size() != 3) {
    fail("<{}>: {} is \"{}\", expected 3 numbers", name(), attribute_name, shown(value));
  }
  return Vec3((*v)[0], (*v)[1], (*v)[2]);
}

Vec3 XmlElement::attribute_vector(const char* attribute_name, const Vec3& otherwise) const {
  return attribute(attribute_name) ? require_attribute_vector(attribute_name) : otherwise;
}

XmlFile::XmlFile(std::filesystem::path file) : file_(std::move(file)) {
  const std::string content = read_text_file(file_);
  if (document_.Parse(content.data(), content.size()) != tinyxml2::XML_SUCCESS) {
    fail_at(file_, document_.ErrorLineNum(), "is not well-formed XML ({})", document_.ErrorName());
  }
  if (!document_.RootElement()) fail_at(file_, 0, "holds no XML element, expected one");
}

XmlElement XmlFile::require_root(const char* root_name) const {
  if (root().name() != root_name) {
    root().fail("the outermost element is <{}>, expected <{}>", root().name(), root_name);
  }
  return root();
}

}  // namespace eigengrasp
