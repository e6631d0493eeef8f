// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small arm as URDF with its meshes: joints that turn, slide, spin, stay and follow, a scale, primitives, a mast that
// always meets the shoulder.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

/// A closed mesh around the axis z as Wavefront OBJ: `profile` lists radius and height of its rings.
function turnedMesh(profile, sides = 18, factor = 1) {
  const vertices = [[0, 0, profile[0][1]]];
  for (const [radius, z] of profile)
    for (let i = 0; i < sides; ++i) vertices.push([radius * Math.cos((2 * Math.PI * i) / sides), radius * Math.sin((2 * Math.PI * i) / sides), z]);
  vertices.push([0, 0, profile.at(-1)[1]]);
  const at = (ring, i) => 1 + ring * sides + (i % sides);
  const triangles = [];
  for (let i = 0; i < sides; ++i) {
    triangles.push([0, at(0, i + 1), at(0, i)], [vertices.length - 1, at(profile.length - 1, i), at(profile.length - 1, i + 1)]);
    for (let ring = 0; ring + 1 < profile.length; ++ring)
      triangles.push([at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)], [at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)]);
  }
  return [...vertices.map((v) => `v ${v.map((c) => c * factor).join(' ')}`), ...triangles.map((t) => `f ${t.map((i) => i + 1).join(' ')}`)].join('\n') + '\n';
}

/// The outline of a bone: a thick end, a waist, and a thinner end.
function bone(length, thick, thin) {
  const cap = (radius, middle, from, to) =>
    Array.from({ length: 4 }, (_, i) => {
      const angle = from + ((to - from) * (i + 0.5)) / 4;
      return [radius * Math.cos(angle), middle + 0.8 * radius * Math.sin(angle)];
    });
  const waist = 0.62 * thin;
  return [...cap(thick, 0, -Math.PI / 2, 0.9), [waist, 0.45 * length], [waist, 0.7 * length], ...cap(thin, length, -0.9, Math.PI / 2)];
}

const kUrdf = `<?xml version="1.0"?>
<robot name="small arm">
  <link name="world"/>
  <link name="base">
    <collision><geometry><mesh filename="package://arm/base.obj"/></geometry></collision>
  </link>
  <link name="shoulder">
    <collision><origin xyz="0 0.07 0" rpy="1.5707963 0 0"/>
      <geometry><cylinder radius="0.062" length="0.16"/></geometry></collision>
  </link>
  <link name="mast">
    <collision><geometry><cylinder radius="0.012" length="0.08"/></geometry></collision>
  </link>
  <link name="upper_arm">
    <collision><geometry><mesh filename="package://arm/upper.obj"/></geometry></collision>
  </link>
  <link name="forearm">
    <collision><origin xyz="0 -0.01 0" rpy="0 0 0.3"/>
      <geometry><mesh filename="package://arm/fore.obj" scale="0.001 0.001 0.001"/></geometry></collision>
  </link>
  <link name="wrist">
    <collision><origin xyz="0 0 0.02"/><geometry><box size="0.05 0.11 0.03"/></geometry></collision>
    <collision><origin xyz="0 0 -0.01"/><geometry><sphere radius="0.03"/></geometry></collision>
  </link>
  <link name="finger_left">
    <collision><origin xyz="0 0 0.045"/><geometry><box size="0.024 0.014 0.09"/></geometry></collision>
  </link>
  <link name="finger_right">
    <collision><origin xyz="0 0 0.045"/><geometry><box size="0.024 0.014 0.09"/></geometry></collision>
  </link>
  <joint name="stand" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0.2 0 0.1"/></joint>
  <joint name="hold" type="fixed"><parent link="base"/><child link="mast"/><origin xyz="0 0 0.2"/></joint>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="shoulder"/><origin xyz="0 0 0.25" rpy="0 0 0.4"/><axis xyz="0 0 1"/>
    <limit lower="-2.9671" upper="2.9671" effort="10" velocity="1"/>
  </joint>
  <joint name="lift" type="revolute">
    <parent link="shoulder"/><child link="upper_arm"/><origin xyz="0 0.1 0.03" rpy="0 0.35 0"/><axis xyz="0 3 0"/>
    <limit lower="-1.8" upper="2.3" effort="10" velocity="1"/>
  </joint>
  <joint name="bend" type="revolute">
    <parent link="upper_arm"/><child link="forearm"/><origin xyz="0 -0.075 0.34" rpy="0 1.1 0"/><axis xyz="0 1 0"/>
    <limit lower="-2.8" upper="2.4" effort="10" velocity="1"/>
  </joint>
  <joint name="spin" type="continuous">
    <parent link="forearm"/><child link="wrist"/><origin xyz="0 -0.01 0.33"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="grip" type="prismatic">
    <parent link="wrist"/><child link="finger_left"/><origin xyz="0 0.012 0.035"/><axis xyz="0 1 0"/>
    <limit lower="0.004" upper="0.036" effort="10" velocity="1"/>
  </joint>
  <joint name="grip_right" type="prismatic">
    <parent link="wrist"/><child link="finger_right"/><origin xyz="0 -0.012 0.035"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.04" effort="10" velocity="1"/><mimic joint="grip" multiplier="1" offset="0.001"/>
  </joint>
</robot>
`;

/// Writes the arm into a folder; returns the URDF. `package://arm` is the folder itself.
export function writeArm(folder) {
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, 'base.obj'), turnedMesh([[0.11, 0], [0.12, 0.012], [0.12, 0.05], [0.07, 0.085], [0.06, 0.13], [0.066, 0.15], [0.066, 0.18], [0.05, 0.19]], 24));
  writeFileSync(join(folder, 'upper.obj'), turnedMesh(bone(0.34, 0.064, 0.052)));
  writeFileSync(join(folder, 'fore.obj'), turnedMesh(bone(0.29, 0.05, 0.036), 18, 1000));
  const urdf = join(folder, 'arm.urdf');
  writeFileSync(urdf, kUrdf);
  return urdf;
}
