# Arrows point one way: builder -> core, plugin -> core, demos -> plugin, core (and builder, to make their trees). Bullet is
# seen only in plugin/ and above, CGAL, Eigen and assimp only in builder/ (and in the demos' independent check).
#   cmake -DROOT=<source folder> -P CheckArrows.cmake

function(forbid room pattern why)
  file(GLOB_RECURSE files ${ROOT}/${room}/*.h ${ROOT}/${room}/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]${pattern}")
    foreach(line IN LISTS lines)
      file(RELATIVE_PATH name ${ROOT} ${file})
      message(SEND_ERROR "${name}: ${line}\n  ${why}")
    endforeach()
  endforeach()
endfunction()

set(bullet "(bt[A-Z]|Bullet|LinearMath/)")
set(geometry "(CGAL/|Eigen/|assimp/)")
foreach(room core builder)
  forbid(${room} "${bullet}" "Only plugin/ and what stands on it sees Bullet.")
endforeach()
foreach(room core plugin)
  forbid(${room} "${geometry}" "Only builder/ sees CGAL, Eigen and assimp.")
endforeach()
forbid(core "cairn/(builder|bullet)/" "core/ stands alone.")
forbid(builder "cairn/bullet/" "builder/ and plugin/ never meet.")
forbid(plugin "cairn/builder/" "builder/ and plugin/ never meet.")
foreach(room core builder plugin)
  forbid(${room} "(scenes|frame_budget|rockfall|support)/" "Libraries know nothing of demos and tests.")
endforeach()
