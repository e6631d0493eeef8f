// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/figures/draw.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "accuracy_cost/figures/gnuplot_script.h"
#include "cairn/core/atomic_file.h"
#include "scenes/command/subprocess.h"

namespace cairn::accuracy_cost {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMissing =
    "gnuplot is needed to draw figures: install the package gnuplot-nox, or use --no-figures";

/// The first message of gnuplot.
std::string complaintIn(const fs::path& log) {
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);)
    if (line.find_first_not_of(" \t^") != std::string::npos) return line;
  return "it does not say why";
}

/// Runs a script from a temporary file beside the picture.
Status runScript(const std::string& script, const fs::path& picture) {
  const fs::path source = picture.string() + ".gnuplot", log = picture.string() + ".log";
  if (Status written = writeFileAtomically(source, script); !written) return written;
  const int code = scenes::runCommand({"gnuplot", source.string()}, log);
  Status status;
  if (code == -ENOENT)
    status = Error{kMissing};
  else if (code != 0)
    status = Error{fmt::format("gnuplot could not draw {}: {}", picture.filename().string(), complaintIn(log))};
  std::error_code ignored;
  fs::remove(source, ignored);
  fs::remove(log, ignored);
  return status;
}

}  // namespace

Status checkGnuplot() {
  return scenes::runCommand({"gnuplot", "--version"}, "/dev/null") == 0 ? Status() : Error{kMissing};
}

Result<std::vector<std::string>> drawFigure(const Figure& figure, const Table& table, const fs::path& csv,
                                            const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& [format, ending] : {std::pair(PictureFormat::svg, ".svg"), std::pair(PictureFormat::png, ".png")}) {
    const fs::path picture = folder / (figure.name + ending);
    const Status drawn = writeFileAtomically(picture, [&](const fs::path& temporary) {
      return runScript(gnuplotScript(figure, table, csv, format, temporary), temporary);
    });
    if (!drawn) return drawn.error();
    names.push_back(picture.filename().string());
  }
  return names;
}

}  // namespace cairn::accuracy_cost
