// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a fuzz target without a fuzzer: over all files of a folder, each as it is and cut short or changed in a few
// bytes, by numbers that are the same every time. Usage: PROGRAM FOLDER CHANGES [SEED]
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;

Input changed(Input input, std::mt19937_64& engine) {
  if (engine() % 8 == 0) input.resize(engine() % (input.size() + 1));
  const std::uint64_t changes = 1 + engine() % 8;
  for (std::uint64_t i = 0; i < changes && !input.empty(); ++i)
    input[engine() % input.size()] = static_cast<std::uint8_t>(engine());
  return input;
}

/// Kept until it has been survived, so that what ends the program can be looked at.
void run(const Input& input, const std::filesystem::path& last) {
  std::ofstream(last, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()), std::streamsize(input.size()));
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s FOLDER CHANGES [SEED]\n", argv[0]);
    return 2;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) files.push_back(entry.path());
  std::ranges::sort(files);
  const auto last = std::filesystem::temp_directory_path() /
                    (std::filesystem::path(argv[0]).filename().string() + "." + std::to_string(getpid()));
  std::mt19937_64 engine(argc > 3 ? std::stoull(argv[3]) : 1);
  const std::uint64_t changes = std::stoull(argv[2]);
  std::uint64_t runs = 0;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const Input input(text.begin(), text.end());
    run(input, last);
    ++runs;
    for (std::uint64_t i = 0; i < changes; ++i, ++runs) run(changed(input, engine), last);
  }
  std::filesystem::remove(last);
  std::printf("%llu inputs from %zu files: none ended it\n", static_cast<unsigned long long>(runs), files.size());
  return files.empty() ? 1 : 0;
}
