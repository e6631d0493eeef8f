// SPDX-License-Identifier: Zlib
//
// Drops bodies of a tree between walls, as wasm/ratio/heap_time.mjs does by the npm package: the same calls, natively.
// Prints how the heap ends and the CPU milliseconds of each step as JSON.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "cairn/core/tree_file.h"
#include "simulation/simulation.h"

namespace {

using cairn::simulation::Pose;
using cairn::simulation::Simulation;
using Shape = std::shared_ptr<cairn::bullet::SphereTreeShape>;

// Numbers from -1 to 1: Knuth's MMIX generator, of which JavaScript can do the same with integers of any length.
class Random {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return double(state_ >> 32) / 2147483648.0 - 1.0;
  }

 private:
  std::uint64_t state_ = 1;
};

btQuaternion rotation(Random& random) {
  double q[4], squared = 0;
  for (double& part : q) {
    part = random.next();
    squared += part * part;
  }
  const double length = std::sqrt(squared);
  return {btScalar(q[0] / length), btScalar(q[1] / length), btScalar(q[2] / length), btScalar(q[3] / length)};
}

cairn::Status fill(Simulation& heap, const Shape& shape, int bodies) {
  const double size = double(shape->size());
  const btVector3 inwards[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  if (auto status = heap.addPlane({0, 0, 1}, 0, {}); !status) return status;
  for (const btVector3& normal : inwards)
    if (auto status = heap.addPlane(normal, btScalar(-2 * size), {}); !status) return status;
  Random random;
  for (int i = 0; i < bodies; ++i) {
    const double x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 + 1;
    const Pose pose{{btScalar(x * size), btScalar(y * size), btScalar(z * size)}, rotation(random)};
    if (auto added = heap.addBody(shape, 1, pose, {}); !added) return added.error();
  }
  return {};
}

int refused(const cairn::Error& error) {
  std::fprintf(stderr, "heap_time: %s\n", error.message.c_str());
  return 1;
}

// CPU time, which a busy machine hardly changes.
double cpuMs() {
  return 1000.0 * double(std::clock()) / CLOCKS_PER_SEC;
}

void run(Simulation& heap, int steps) {
  std::vector<double> times;
  for (int i = 0; i < steps; ++i) {
    const double began = cpuMs();
    heap.step();
    times.push_back(cpuMs() - began);
  }
  std::printf("{\"hash\": \"%s\", \"cpuMs\": [", heap.stateHash().c_str());
  for (std::size_t i = 0; i < times.size(); ++i) std::printf("%s%.4f", i == 0 ? "" : ", ", times[i]);
  std::printf("]}\n");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) return std::fprintf(stderr, "usage: heap_time TREE BODIES STEPS OPERATIONS (0: no budget)\n"), 2;
  auto tree = cairn::loadTree(arguments[1]);
  if (!tree) return refused(tree.error());
  auto shape = cairn::bullet::SphereTreeShape::create(std::move(tree).value());
  if (!shape) return refused(shape.error());
  auto heap = Simulation::create({0, 0, btScalar(-9.81)}, btScalar(1.0 / 60));
  if (!heap) return refused(heap.error());
  cairn::bullet::StepBudget budget;
  if (const long operations = std::atol(arguments[4]); operations > 0) budget.operations = operations;
  if (const auto status = heap.value()->narrowPhase().setBudget(budget); !status) return refused(status.error());
  if (const auto status = fill(*heap.value(), std::move(shape).value(), std::atoi(arguments[2])); !status)
    return refused(status.error());
  run(*heap.value(), std::atoi(arguments[3]));
}
