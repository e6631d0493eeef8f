#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes stand-ins for the thesis's five models below a folder, each once: bunny, dragon, cow and ellipsoid from the
# meshes of Debian's libcgal-demo, the s-shape computed. Prints their names; what cannot be had is left out with a note.
#   meshes.sh TOOL ARCHIVE.tar.gz FOLDER
set -euo pipefail
tool=$1 archive=$2 folder=$3
mkdir -p "$folder"

extract() { tar -xzf "$archive" -O "data/meshes/$1" > "$folder/$1"; }

# Of as many triangles as the thesis's; a mesh that is open or crosses itself goes through a tight wrap first.
prepare() {
  local name=$1 source=$2 wrapped=$3
  extract "$source" || return 1
  if [[ $wrapped == wrapped ]]; then
    "$tool" build "$folder/$source" -o "$folder/skin.cairn" --mesh-output "$folder/skin.ply" --wrap --wrap-alpha 0.01 \
      --wrap-offset 0.001 --method octree --depth 1 --samples 500 --no-evaluate > /dev/null
    source=skin.ply
  fi
  "$tool" simplify "$folder/$source" --triangles 1500 -o "$folder/$name.obj" > /dev/null
}

# A round tube of radius 0.35 along two arcs of 225 degrees and radius 1, of 16 sides, with flat ends. At s along the S
# from its middle the tube runs towards (sin |s|, cos |s|), and the turn of s < 0 mirrors that of s > 0.
s_shape() {
  awk 'BEGIN {
    pi = atan2(0, -1); sides = 16; rings = 33; reach = 225 * pi / 180
    for (i = 0; i < rings; ++i) {
      s = reach * (2 * i / (rings - 1) - 1); turn = s < 0 ? -s : s; side = s < 0 ? -1 : 1
      x = side * (1 - cos(turn)); y = side * sin(turn)
      for (j = 0; j < sides; ++j) {
        a = 2 * pi * j / sides
        printf "v %.9f %.9f %.9f\n", x + 0.35 * cos(a) * cos(turn), y - 0.35 * cos(a) * sin(turn), 0.35 * sin(a)
      }
      if (i == 0 || i == rings - 1) ends = ends sprintf("v %.9f %.9f 0\n", x, y)
    }
    printf "%s", ends
    n = rings * sides
    for (j = 0; j < sides; ++j) {
      k = (j + 1) % sides
      for (i = 0; i + 1 < rings; ++i) {
        a = i * sides + j + 1; b = i * sides + k + 1
        printf "f %d %d %d\nf %d %d %d\n", a, a + sides, b + sides, a, b + sides, b
      }
      printf "f %d %d %d\nf %d %d %d\n", n + 1, j + 1, k + 1, n + 2, n - sides + k + 1, n - sides + j + 1
    }
  }'
}

make_mesh() {
  case $1 in
    bunny) prepare bunny bunny00.off plain ;;
    dragon) prepare dragon ChineseDragon-10kv.off wrapped ;;
    cow) prepare cow cow.off wrapped ;;
    s-shape) s_shape > "$folder/s-shape.part" && mv "$folder/s-shape.part" "$folder/s-shape.obj" ;;
    ellipsoid) prepare ellipsoid ellipsoid.off plain ;;
  esac
}

for name in bunny dragon cow s-shape ellipsoid; do
  if [[ -s $folder/$name.obj ]] || make_mesh "$name" >&2; then
    printf '%s\n' "$folder/$name.obj"
  else
    echo "meshes.sh: no $name: is $archive of libcgal-demo there? Going on without" >&2
  fi
done
