/* SPDX-License-Identifier: Zlib
 *
 * A game in plain C: rocks fall on a plane. Prints each rock's height at the end.
 * Usage: game TREE
 */
#include <cairn/cairn.h>
#include <stdio.h>
#include <string.h>

static int fail(const char* what) {
  fprintf(stderr, "%s: %s\n", what, cairnError());
  return 1;
}

int main(int argc, char** argv) {
  const float up[3] = {0, 1, 0};
  const CairnBudget budget = {20000, CAIRN_NO_LIMIT};
  CairnTree* tree;
  CairnShape* shape;
  CairnWorld* world;
  CairnStatistics statistics;
  char hash[17];
  int i;

  if (argc != 2) return 2;
  if (cairnLoadTree("no such file.cairn") || !strstr(cairnError(), "no such file.cairn")) return fail("a missing file");
  tree = cairnLoadTree(argv[1]);
  if (!tree) return fail("the tree");
  shape = cairnMakeShape(tree, NULL);
  cairnFreeTree(tree); /* the shape keeps it */
  if (!shape) return fail("the shape");
  world = cairnMakeWorld(NULL);
  if (!world) return fail("the world");
  if (!cairnSetBudget(world, &budget) || !cairnAddPlane(world, up, 0, NULL)) return fail("the ground");
  for (i = 0; i < 10; ++i) {
    CairnPose pose = {{0, 0, 0}, {0, 0, 0, 1}};
    pose.position[0] = 0.5F * (float)(i % 2);
    pose.position[1] = (1.0F + (float)i) * cairnShapeSize(shape);
    if (cairnAddBody(world, shape, 1, &pose, NULL) != i) return fail("a rock");
  }
  cairnFreeShape(shape); /* its bodies keep it */
  for (i = 0; i < 600; ++i)
    if (!cairnStep(world)) return fail("a step");
  cairnLastStep(world, &statistics);
  cairnStateHash(world, hash);
  fprintf(stderr, "Cairn %s: %u pairs, %u contacts, state %s\n", cairnVersion(), (unsigned)statistics.pairs,
          (unsigned)statistics.contacts, hash);
  for (i = 0; i < cairnBodyCount(world); ++i) {
    CairnPose pose;
    if (!cairnGetPose(world, i, &pose)) return fail("a pose");
    printf("%g\n", pose.position[1]);
  }
  cairnFreeWorld(world);
  return 0;
}
