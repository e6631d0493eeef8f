# Reports of `cairn build --json` in; {builds, ratios} out. $thesis: thesis.tsv.

# Error of a method's level over that of another one, in the thesis's own measure (sampled) and in the certified one.
def level_of($builds; $model; $method; $level):
  first($builds[] | select(.model == $model and .method == $method) | .levels[] | select(.level == $level)) // null;
def ratio($a; $b; $key): if $a == null or $b == null or $b[$key] == 0 then null else $a[$key] / $b[$key] end;

. as $builds
| [$thesis | split("\n")[] | select(length > 0 and (startswith("#") | not)) | split("\t")
   | {table: .[0], model: .[1], first: .[2], second: .[3], level: (.[4] | tonumber),
      thesis_max: (.[5] | tonumber), thesis_rms: (.[6] | tonumber)}
   | . as $row | select(any($builds[]; .model == $row.model))
   | level_of($builds; .model; .first; .level) as $a | level_of($builds; .model; .second; .level) as $b
   | . + {sampled_max: ratio($a; $b; "sampled_max_fraction"), sampled_rms: ratio($a; $b; "sampled_rms_fraction"),
          certified_max: ratio($a; $b; "certified_max_fraction"), certified_rms: ratio($a; $b; "certified_rms_fraction")}]
| {builds: $builds, ratios: .}
