// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <iostream>

#include "cairn/core/version.h"
#include "tool/command.h"
#include "tool/interrupt.h"

namespace {

constexpr const char* kAbout =
    "Turns meshes into certified sphere-trees for collision detection.\n\n"
    "  cairn build rock.obj -o rock.cairn          make a tree and print how well each level fits\n"
    "  cairn certify rock.obj rock.cairn           prove that a tree covers a mesh\n"
    "  cairn evaluate rock.obj rock.cairn          measure the fit again\n"
    "  cairn inspect rock.cairn                    what is in a tree file\n"
    "  cairn export rock.cairn --to glb -o rock.glb   look at the spheres of a level\n"
    "  cairn view rock.cairn -o rock.html          the same in a browser: levels, errors, single spheres\n"
    "  cairn bound rock.obj --tree rock.cairn      how near each level is to the best possible\n"
    "  cairn cover link.obj --spheres 20 -o link.txt   a flat set of spheres, with its proof\n"
    "  cairn robot arm.urdf -o out.urdf --total 200   spheres for every link of a robot, with proofs\n"
    "  cairn simplify scan.ply -o rock.obj         fewer triangles, if a mesh has too many\n"
    "  cairn fracture rock.obj -o pieces           meshes and trees of the pieces it breaks into\n"
    "  cairn advise rock.obj --bodies 50 --budget-us 500   which tree and budget to use, measured on this machine\n\n"
    "Exit codes: 0 done, 1 input refused or check failed, 2 wrong usage, 130 cancelled.";

int run(int argc, char** argv) {
  CLI::App app(kAbout, "cairn");
  app.require_subcommand(1);
  app.set_version_flag("--version", CAIRN_VERSION);
  cairn::tool::Action action;
  cairn::tool::addBuildCommand(app, action);
  cairn::tool::addEvaluateCommand(app, action);
  cairn::tool::addCertifyCommand(app, action);
  cairn::tool::addInspectCommand(app, action);
  cairn::tool::addExportCommand(app, action);
  cairn::tool::addViewCommand(app, action);
  cairn::tool::addSimplifyCommand(app, action);
  cairn::tool::addBoundCommand(app, action);
  cairn::tool::addCoverCommand(app, action);
  cairn::tool::addRobotCommand(app, action);
  cairn::tool::addFractureCommand(app, action);
  cairn::tool::addAdviseCommand(app, action);
  const auto isMeant = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(isMeant).empty()) {
    fmt::print(stderr, "cairn: there is no command '{}'; `cairn --help` lists them\n", argv[1]);
    return cairn::tool::kWrongUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    return app.exit(wanted);
  } catch (const CLI::ParseError& e) {
    fmt::print(stderr, "cairn: {}; `cairn --help` explains\n", e.what());
    return cairn::tool::kWrongUsage;
  }
  cairn::tool::catchInterrupts();
  return action();
}

int guardedRun(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "cairn: stopped by an unexpected failure ({}); nothing was written\n", e.what());
    return cairn::tool::kRefused;
  }
}

/// Whether all that was printed arrived; a full disk is noticed here at the latest.
bool outputArrived() {
  std::cout.flush();
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int code = guardedRun(argc, argv);
  if (code != cairn::tool::kDone || outputArrived()) return code;
  fmt::print(stderr, "cairn: standard output cannot be written; check where it leads\n");
  return cairn::tool::kRefused;
}
