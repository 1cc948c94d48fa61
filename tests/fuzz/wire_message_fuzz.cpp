// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Whatever a client or a log says, the reader of the wire gives a message that survives writing and reading
// again, or throws one Error of one line. With libFuzzer (preset fuzz): wire_message_fuzz
// tests/fuzz/corpus/wire. Without: the program replays the files and folders that it is given; files whose
// names begin with ok_ must be read, those with bad_ refused.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/wire/wire_text.hpp"

namespace {

namespace fs = std::filesystem;
namespace wire = eigengrasp::wire;

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::abort();
}

/// Whether the text is read; any outcome but a message or a sentence ends the program.
template <typename Parse>
bool reads(std::string_view text, Parse parse) {
  std::string written;
  try {
    written = wire::to_text(parse(text));
  } catch (const eigengrasp::Error& e) {
    const std::string sentence = e.what();
    if (sentence.find('\n') != std::string::npos) give_up("the error has two lines: " + sentence);
    if (sentence.size() > 2000) give_up("the error is too long: " + sentence);
    return false;
  }
  if (wire::to_text(parse(written)) != written) give_up("is not the same when it is read again: " + written);
  return true;
}

bool is_message(std::string_view text) {
  const bool client = reads(text, [](std::string_view t) { return wire::parse_client_message(t); });
  const bool server = reads(text, [](std::string_view t) { return wire::parse_server_message(t); });
  return client || server;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  is_message({reinterpret_cast<const char*>(data), size});
  return 0;
}

#ifndef EIGENGRASP_LIBFUZZER
namespace {

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void replay(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::string text = content_of(file);
  const bool good = is_message(text);
  if (name.starts_with("ok_") && !good) give_up(name + ": is refused, expected to be read");
  if (name.starts_with("bad_") && good) give_up(name + ": is read, expected to be refused");
  for (std::size_t i = 0; i < text.size(); i += 1 + text.size() / 50) {  // cut, and with one byte changed
    is_message(std::string_view(text).substr(0, i));
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
    is_message(changed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i) {
    if (!fs::is_directory(argv[i])) {
      files.emplace_back(argv[i]);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(argv[i])) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) replay(file);
  std::printf("%zu files\n", files.size());
  return files.empty() ? 1 : 0;
}
#endif
