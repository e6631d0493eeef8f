# SPDX-License-Identifier: GPL-3.0-or-later
#
# Writes an OBJ file of triangles with each cut into four at the middles of its edges.
function middle(a, b,  key) {
  key = a < b ? a " " b : b " " a
  if (!(key in middles)) {
    middles[key] = ++vertices
    for (axis = 1; axis <= 3; axis++) at[axis, vertices] = (at[axis, a] + at[axis, b]) / 2
  }
  return middles[key]
}
$1 == "v" { vertices++; for (axis = 1; axis <= 3; axis++) at[axis, vertices] = $(axis + 1) }
$1 == "f" { faces++; for (i = 1; i <= 3; i++) corner[i, faces] = $(i + 1) + 0 }  # the number before a slash
END {
  for (f = 1; f <= faces; f++) {
    a = corner[1, f]; b = corner[2, f]; c = corner[3, f]
    ab = middle(a, b); bc = middle(b, c); ca = middle(c, a)
    face[++count] = a " " ab " " ca; face[++count] = ab " " b " " bc
    face[++count] = ca " " bc " " c; face[++count] = ab " " bc " " ca
  }
  for (v = 1; v <= vertices; v++) printf "v %.17g %.17g %.17g\n", at[1, v], at[2, v], at[3, v]
  for (f = 1; f <= count; f++) print "f", face[f]
}
