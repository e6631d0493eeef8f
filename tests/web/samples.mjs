// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two rocks' ways, in the two formats of `rockfall merge`.

export const vtkOfTwoRocks = `# vtk DataFile Version 3.0
Cairn rock-fall trajectories, metres
ASCII
DATASET POLYDATA
POINTS 5 double
100 200 50
101 202 49
102 203 46
90 200 1e1
95 200 8.5
LINES 2 7
3 0 1 2
2 3 4
CELL_DATA 2
SCALARS run int 1
LOOKUP_TABLE default
0
0
POINT_DATA 5
SCALARS time_s float 1
LOOKUP_TABLE default
0
1
2
4
5
SCALARS speed_m_per_s float 1
LOOKUP_TABLE default
0
1
2
0
1
`;

const rock = (coordinates, properties) => ({ type: 'Feature', properties, geometry: { type: 'MultiLineString', coordinates: [coordinates] } });

export const geoJsonOfTwoRocks = JSON.stringify({
  type: 'FeatureCollection',
  name: 'trajectories',
  features: [
    rock([[100, 200, 50], [101, 202, 49], [102, 203, 46]], { run: 0, rock: 0, ending: 'resting', sieve_m: 0.4, time_s: 2 }),
    rock([[90, 200, 10], [95, 200, 8.5]], { run: 0, rock: 1, ending: 'resting', sieve_m: 0.75, time_s: 1 }),
  ],
});
