// SPDX-License-Identifier: Zlib
#include "cairn/core/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <system_error>

#include "platform/files.h"

namespace cairn {

namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason() {
  return std::strerror(errno);
}

Error cannot(const char* what, const fs::path& path, const std::string& why) {
  return Error{std::string("cannot ") + what + " " + path.string() + ": " + why};
}

// In the same folder, so that the rename stays within one file system; hidden, unpredictable, same extension.
fs::path temporaryBeside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  static const unsigned process = std::random_device{}();
  constexpr std::size_t kStem = 100;  // of the longest names there may be, so that what is added always fits
  const std::string name =
      "." + path.stem().string().substr(0, kStem) + "." + std::to_string(process) + "-" + std::to_string(counter++);
  return path.parent_path() / (name + ".partial" + path.extension().string());
}

class RemovedUnlessKept {
 public:
  explicit RemovedUnlessKept(fs::path path) : path_(std::move(path)) {}
  ~RemovedUnlessKept() {
    std::error_code ignored;
    if (!kept_) fs::remove(path_, ignored);
  }
  RemovedUnlessKept(const RemovedUnlessKept&) = delete;
  RemovedUnlessKept& operator=(const RemovedUnlessKept&) = delete;

  const fs::path& path() const { return path_; }
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  bool kept_ = false;
};

Status writePlainly(const fs::path& path, platform::Open how, std::span<const std::byte> bytes,
                    const fs::path& nameForErrors) {
  const File file(platform::openFile(path, how));
  if (!file) return cannot("write", nameForErrors, reason());
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size() || !platform::flushToDisk(file.get()))
    return cannot("write", nameForErrors, reason());
  return {};
}

// A device, a pipe: something that a rename would replace instead of writing to it.
bool isSpecial(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) && fs::exists(b, ignored))
    // Two outputs may go to one device or pipe; only a file would be lost.
    return fs::is_regular_file(a, ignored) && fs::equivalent(a, b, ignored);
  return fs::weakly_canonical(behindLinks(a), ignored) == fs::weakly_canonical(behindLinks(b), ignored);
}

}  // namespace

fs::path behindLinks(fs::path path) {
  constexpr int kMaxLinks = 40;  // as many as Linux follows: beyond are circles
  std::error_code failure;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(path, failure); ++i) {
    const fs::path next = fs::read_symlink(path, failure);
    if (failure) break;
    path = path.parent_path() / next;
  }
  return path;
}

Status writeFileAtomically(const fs::path& path, const std::function<Status(const fs::path&)>& write) {
  if (path.filename().empty()) return cannot("write", path, "it is not a file name");
  if (isSpecial(path)) return cannot("write", path, "it is not a regular file");
  const fs::path target = behindLinks(path);
  std::error_code failure;
  if (fs::is_symlink(target, failure)) return cannot("write", path, "its links lead in a circle");
  RemovedUnlessKept temporary(temporaryBeside(target));
  if (Status written = write(temporary.path()); !written) return written;
  fs::rename(temporary.path(), target, failure);
  if (failure) return cannot("write", path, failure.message());
  temporary.keep();
  return {};
}

Status writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
  if (isSpecial(path)) return writePlainly(path, platform::Open::write, bytes, path);
  return writeFileAtomically(
      path, [&](const fs::path& temporary) { return writePlainly(temporary, platform::Open::writeNew, bytes, path); });
}

Status writeFileAtomically(const fs::path& path, std::string_view text) {
  return writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

Status checkWritable(const fs::path& path) {
  const auto refuse = [&](const std::string& why) { return Error{path.string() + ": " + why}; };
  std::error_code ignored;
  if (path.empty()) return Error{"the output has no name; name a file"};
  if (fs::is_directory(path, ignored)) return refuse("it is a folder; name a file in it");
  if (isSpecial(path)) return platform::mayWrite(path) ? Status{} : refuse("it may not be written; name another file");
  const fs::path target = behindLinks(path);
  if (fs::is_symlink(target, ignored)) return refuse("its links lead in a circle; name another file");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (!fs::is_directory(folder, ignored))
    return refuse("the folder " + folder.string() + " does not exist; create it first");
  if (!platform::mayWrite(folder))
    return refuse("the folder " + folder.string() + " may not be written; choose another one");
  return {};
}

Status checkOutputs(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs) {
  std::vector<fs::path> others = inputs;
  for (const fs::path& output : outputs) {
    if (output.empty()) continue;
    if (Status s = checkWritable(output); !s) return s;
    for (const fs::path& other : others)
      if (!other.empty() && isSameFile(output, other))
        return Error{output.string() + ": the output is the same file as " + other.string() + "; name another one"};
    others.push_back(output);
  }
  return {};
}

Result<std::vector<std::byte>> readFile(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return cannot("read", path, "it is a folder");
  const File file(platform::openFile(path, platform::Open::read));
  if (!file) return cannot("read", path, reason());
  std::vector<std::byte> bytes;
  std::byte chunk[1 << 16];
  while (const std::size_t got = std::fread(chunk, 1, sizeof(chunk), file.get()))
    bytes.insert(bytes.end(), chunk, chunk + got);
  if (std::ferror(file.get()) != 0) return cannot("read", path, reason());
  return bytes;
}

}  // namespace cairn
