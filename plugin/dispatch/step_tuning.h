// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>

namespace cairn::bullet::step_tuning {

// All numbers by which a step divides its time and operations. None of them changes a contact.

/// Weight of a new complete traversal in the expected cost of others: about sixteen pairs are remembered. Without it,
/// plans use the first guess for ever (`Budget_GoldenHash` changes).
inline constexpr double kLearning = 1.0 / 16;
/// Share of a step's rest, after carrying over, for coarse looks at pairs without an answer. At 0.9 towers fall asleep
/// late (`Sleep.IsNotOnGuardsThatCarry`). At 0 flying bodies err by their whole size
/// (`CoarseLook.LeavesNoFlyingPairToTheSpheresOfWholeBodies`, `ErrsLessTheMoreItIsGiven`).
inline constexpr double kCoarseShare = 0.4;

/// While budgets are scarce, a pair with an answer measures everything near once in this many steps, and only its
/// contacts in the others.
inline constexpr std::uint64_t kStepsOfThrift = 4;
/// Longest run of steps that serve no pair that can be carried over. The limit prevents starvation.
inline constexpr std::uint32_t kMaxStepsWithoutTurn = 7;
/// Operations that every step gets, however short its time: two turns, some three microseconds with contacts.
inline constexpr std::uint64_t kMinOperations = 160;

/// A pair that is carried over measures its new leaf pairs at once when measuring takes this part of a step. If it were
/// left to the end, the reservation would leave the next steps nothing for refinement
/// (`HeldPairs.ThatCostMoreThanAStepHasComeToAnAnswer`).
inline constexpr double kLargeShareOfStep = 0.75;
/// Nanoseconds an operation of carrying over, before anything is learnt: 150 nanoseconds a pair.
inline constexpr double kCarryOverCost = 5;
/// Pairs carried over between two looks at the clock. More end a step later, fewer spend more on the clock.
inline constexpr std::size_t kCarriedBetweenClockLooks = 8;

/// Updated pairs, before anything is learnt: nanoseconds an operation, and a pair's fixed share in operations. A pair
/// takes 1 to 2 microseconds beside 5 to 10 nanoseconds an operation. With a smaller share, the cost of many small
/// pairs makes large ones look as if they never fit.
inline constexpr double kUpdateCost = 20, kUpdateWeight = 200;
/// Meshes, before anything is learnt: nanoseconds an operation, a pair's fixed share in operations, and the operations
/// of a first question. For a machine of 2 GHz and meshes of 1500 triangles.
inline constexpr double kMeshCost = 20, kMeshWeight = 200, kFirstMeshOperations = 2000;
/// Fraction by which the expected cost of meshes falls in each step without time to ask: by half in twelve seconds
/// (`MeshTime.IsHopedToBeLessWhereNothingIsAsked`).
inline constexpr double kHope = 0.001;

/// Steps within which each pair is checked once for rest: memory is given back after four to nine seconds. In a world
/// of 10,000 bodies at rest the check takes some twenty microseconds a step (`RestingPairs.KeepNoMoreThanTheyUse` fails
/// without it).
inline constexpr std::size_t kStepsToLookAtAll = 256;

// Prefetch distances in pairs: about as many as are worked on while memory answers. They change time alone.

/// In Bullet's pass: the data that culls a pair, and the copies.
inline constexpr std::size_t kSubjectsAhead = 8, kCopiesAhead = 4;
inline constexpr std::size_t kNamesAhead = 8;                                         ///< while pairs are ordered
inline constexpr std::size_t kStatesAhead = 3, kListsAhead = 2, kLeafPairsAhead = 1;  ///< while pairs are begun
inline constexpr std::size_t kCarriedAhead = 5, kCarriedBodiesAhead = 3,
                             kCarriedPointsAhead = 2;  ///< while pairs are carried over
inline constexpr std::size_t kIdleAhead = 2;           ///< while pairs are made, often many at a time

}  // namespace cairn::bullet::step_tuning
