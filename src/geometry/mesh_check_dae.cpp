// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <charconv>
#include <string>

#include "eigengrasp/core/error.hpp"
#include "geometry/mesh_file_checks.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

constexpr int kMaxDepth = 200;  // of elements in elements

/// Walks the tags of an XML text, without a tree.
class ColladaCheck {
 public:
  ColladaCheck(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {}

  void run() {
    for (std::size_t at = text_.find('<'); at < text_.size(); at = text_.find('<', at)) {
      if (skip(at, "<!--", "-->") || skip(at, "<![CDATA[", "]]>") || skip(at, "<?", "?>") ||
          skip(at, "<!", ">"))
        continue;
      const std::size_t end = text_.find('>', at);
      if (end == std::string_view::npos) refuse(at, "a tag has no end; the file is cut off");
      check_tag(at, text_.substr(at + 1, end - at - 1));
      at = end + 1;
    }
    if (!collada_) refuse(0, "has no element COLLADA, so it is not a COLLADA file; check what it is");
    if (depth_ != 0) refuse(text_.size(), "ends within an element; the file is cut off");
  }

 private:
  [[noreturn]] void refuse(std::size_t at, const std::string& sentence) const {
    const std::string_view before = text_.substr(0, at);
    fail_at(file_, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')), "{}", sentence);
  }

  bool skip(std::size_t& at, std::string_view opening, std::string_view closing) const {
    if (!text_.substr(at).starts_with(opening)) return false;
    const std::size_t end = text_.find(closing, at + opening.size());
    if (end == std::string_view::npos) refuse(at, "a comment or declaration has no end; the file is cut off");
    at = end + closing.size();
    return true;
  }

  void check_tag(std::size_t at, std::string_view tag) {
    if (tag.starts_with('/')) {
      if (--depth_ < 0) refuse(at, "closes an element that is not open; mend the file");
      return;
    }
    const std::string_view name = tag.substr(0, tag.find_first_of(" \t\r\n/"));
    collada_ |= name == "COLLADA";
    check_counts(at, tag);
    if (tag.ends_with('/')) return;
    if (++depth_ > kMaxDepth) refuse(at, fmt::format("nests elements more than {} deep", kMaxDepth));
    if (name == "p" || name == "vcount" || name == "v") check_integers(at + tag.size() + 2, name);
  }

  /// A count sizes memory; each of its entries takes a byte of the file at least.
  void check_counts(std::size_t at, std::string_view tag) const {
    for (const std::string_view attribute : {" count=", " stride=", " offset=", " set="}) {
      const std::size_t found = tag.find(attribute);
      if (found == std::string_view::npos) continue;
      const std::string_view quoted = tag.substr(std::min(found + attribute.size() + 1, tag.size()));
      std::size_t value = 0;
      const auto [end, error] = std::from_chars(quoted.data(), quoted.data() + quoted.size(), value);
      if (error != std::errc() || value > text_.size() || end == quoted.data() + quoted.size() ||
          (*end != '"' && *end != '\''))
        refuse(at, fmt::format("\"{}\" is no number that fits the file; export the mesh again",
                               TextLines::shown(tag.substr(found + 1))));
    }
  }

  /// A reader that meets anything else waits for the next digit for ever.
  void check_integers(std::size_t at, std::string_view name) const {
    const std::size_t end = std::min(text_.find('<', at), text_.size());
    const std::string_view numbers = text_.substr(at, end - at);
    const std::size_t wrong = numbers.find_first_not_of("0123456789 \t\r\n");
    if (wrong != std::string_view::npos)
      refuse(at + wrong, fmt::format("found \"{}\" in the integers of <{}>; export the mesh again",
                                     TextLines::shown(numbers.substr(wrong, 1)), name));
  }

  const std::filesystem::path& file_;
  std::string_view text_;
  int depth_ = 0;
  bool collada_ = false;
};

}  // namespace

void check_dae(const std::filesystem::path& file, std::string_view content) {
  ColladaCheck(file, content).run();
}

}  // namespace eigengrasp
