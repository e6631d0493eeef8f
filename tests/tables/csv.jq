# One line per mesh, method and level; the keys are those of `cairn build --json`.
["model", "method", "level", "spheres", "certified_max_fraction", "certified_rms_fraction", "sampled_max_fraction",
 "sampled_rms_fraction", "sampled_variance_fraction_squared", "uncovered_area_fraction", "uncovered_volume_fraction",
 "wasted_volume_fraction", "wasted_volume_standard_error_fraction", "build_cpu_s", "peak_rss_mb"] as $columns
| $columns, (.builds[] as $build | $build.levels[] | ($build + .) as $row | [$columns[] | $row[.]])
| @csv
