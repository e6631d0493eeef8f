# The tables as Markdown: a line per method, its levels side by side.
def rounded($digits): pow(10; $digits) as $unit | . * $unit | round / $unit;
def levels($key; $scale; $digits): [.levels[] | .[$key] * $scale | rounded($digits) | tostring] | join(" / ");
def fit_line:
  "| \(.method) | \(levels("spheres"; 1; 0)) | \(levels("certified_max_fraction"; 100; 2)) | \(levels("sampled_max_fraction"; 100; 2))"
  + " | \(levels("sampled_rms_fraction"; 100; 2)) | \(levels("wasted_volume_fraction"; 100; 0)) | \(.build_cpu_s | rounded(1)) | \(.peak_rss_mb | rounded(0)) |";
def cell($ours; $theirs):
  if $ours == null then "- (\($theirs))"
  else ($ours | rounded(2)) as $o | if $o < $theirs then "**\($o)** (\($theirs))" else "\($o) (\($theirs))" end end;
def grouped(key): . as $all | reduce map(key)[] as $k ([]; if index([$k]) then . else . + [$k] end)
  | map(. as $k | $all | map(select(key == $k)));

(.builds | grouped(.model)[]
 | "### \(.[0].model)", "",
   "| method | spheres | certified max % | sampled max % | sampled RMS % | wasted volume % | CPU s | MB |",
   "| --- | --- | --- | --- | --- | --- | --: | --: |", (.[] | fit_line), ""),
(.ratios | grouped(.table)[]
 | "### Table \(.[0].table), \(.[0].model)", "",
   "| ratio | 1: max | RMS | 2: max | RMS | 3: max | RMS |", "| --- | --- | --- | --- | --- | --- | --- |",
   (range(0; length; 3) as $i | .[$i:$i + 3]
    | "| \(.[0].first)/\(.[0].second) | " + (map(cell(.sampled_max; .thesis_max), cell(.sampled_rms; .thesis_rms)) | join(" | ")) + " |"), "")
