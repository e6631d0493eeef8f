// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/mass_properties.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

namespace cairn::builder {
namespace {

Moments momentsAbout(const TriangleMesh& mesh, const Vec3d& reference) {
  Moments m;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    const Vec3d a = corners[0] - reference, b = corners[1] - reference, c = corners[2] - reference;
    const Vec3d sum = a + b + c;
    const double volume = dot(a, cross(b, c)) / 6;
    m.volume += volume;
    m.first += sum * (volume / 4);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        m.second(i, j) += volume / 20 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j]);
    }
  }
  return m;
}

/// Inertia about the centre of mass, per unit of mass, from the integrals about the reference.
Mat3d inertiaOf(const Moments& m) {
  const Vec3d offset = m.first / m.volume;
  Mat3d covariance;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) covariance(i, j) = m.second(i, j) / m.volume - offset[i] * offset[j];
  const double trace = covariance(0, 0) + covariance(1, 1) + covariance(2, 2);
  Mat3d inertia;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inertia(i, j) = (i == j ? trace : 0) - covariance(i, j);
  return inertia;
}

/// Unit vector with its largest coordinate (the first of equals) positive.
Vec3d oriented(const Vec3d& axis) {
  int largest = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(axis[i]) > std::abs(axis[largest])) largest = i;
  return axis[largest] < 0 ? -axis : axis;
}

void diagonalize(MassProperties& mass) {
  const Mat3d& inertia = mass.inertia;
  // Products of inertia this small are rounding of the sums; kept, they would turn a cube's axes anywhere.
  const double negligible = 1e-12 * (inertia(0, 0) + inertia(1, 1) + inertia(2, 2));
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix(i, j) = i != j && std::abs(inertia(i, j)) <= negligible ? 0 : inertia(i, j);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  std::array<Vec3d, 3> axes;
  for (int k = 0; k < 3; ++k) {
    const auto v = solver.eigenvectors().col(k);
    axes[k] = oriented({v[0], v[1], v[2]});
    mass.principalMoments[k] = solver.eigenvalues()[k];
  }
  axes[2] = cross(axes[0], axes[1]);
  mass.principalAxes = transpose(Mat3d{axes});
}

}  // namespace

MassProperties massFromMoments(const Moments& moments, const Vec3d& reference) {
  MassProperties mass;
  mass.volume = moments.volume;
  mass.centerOfMass = reference + moments.first / moments.volume;
  mass.inertia = inertiaOf(moments);
  diagonalize(mass);
  return mass;
}

MassProperties massPropertiesOf(const TriangleMesh& mesh) {
  // About the middle of the mesh, so that a mesh far from its origin loses no digits.
  const Vec3d reference = boundsOf(mesh).center();
  return massFromMoments(momentsAbout(mesh, reference), reference);
}

double signedVolume(const TriangleMesh& mesh) {
  return momentsAbout(mesh, boundsOf(mesh).center()).volume;
}

}  // namespace cairn::builder
