// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Whatever a mesh file holds, load_mesh gives a sound mesh or throws one Error of one line. With libFuzzer
// (preset fuzz): mesh_reader_fuzz tests/fuzz/corpus/mesh. Without: the program replays the files and folders
// that it is given; files whose names begin with ok_ must be read, those with bad_ refused.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"

namespace {

namespace fs = std::filesystem;

[[noreturn]] void give_up(const fs::path& file, const std::string& why) {
  std::fprintf(stderr, "%s: %s\n", file.c_str(), why.c_str());
  std::abort();
}

/// Whether the file is read; any outcome but a sound mesh or a sentence ends the program.
bool reads(const fs::path& file) {
  try {
    const eigengrasp::TriangleMesh mesh = eigengrasp::load_mesh(file);
    eigengrasp::require_sound_mesh(mesh, file.string());
    return true;
  } catch (const eigengrasp::Error& e) {
    const std::string sentence = e.what();
    if (!sentence.starts_with(file.string())) give_up(file, "the error does not name the file: " + sentence);
    if (sentence.find('\n') != std::string::npos) give_up(file, "the error has two lines: " + sentence);
    return false;
  } catch (const std::exception& e) {
    give_up(file, std::string("not an Error: ") + e.what());
  }
}

fs::path scratch_file(const char* ending) {
  return fs::temp_directory_path() / ("mesh_reader_fuzz_" + std::to_string(::getpid()) + "." + ending);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const char* ending : {"obj", "off", "stl", "ply", "gltf", "glb", "dae"}) {
    const fs::path file = scratch_file(ending);
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
    reads(file);
    fs::remove(file);
  }
  return 0;
}

#ifndef EIGENGRASP_LIBFUZZER
namespace {

void replay(const fs::path& file) {
  const std::string name = file.filename().string();
  const bool good = reads(file);
  if (name.starts_with("ok_") && !good) give_up(file, "is refused, expected to be read");
  if (name.starts_with("bad_") && good) give_up(file, "is read, expected to be refused");
  std::ifstream in(file, std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(in)), {});
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
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
