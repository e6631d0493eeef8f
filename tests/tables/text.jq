# The tables as text.
def fixed($digits):
  if . == null then "-"
  else
    pow(10; $digits) as $unit | (if . < 0 then "-" else "" end) as $sign | (fabs * $unit | round) as $n
    | if $digits == 0 then $sign + ($n | tostring)
      else $sign + ($n / $unit | floor | tostring) + "." + ("0000" + ($n % $unit | tostring))[-$digits:] end
  end;
def right($width): tostring | (" " * ($width - length) // "") + .;
def left($width): tostring | . + (" " * ($width - length) // "");
def percent($digits): if . == null then null else 100 * . end | fixed($digits);

def fit_line($build):
  [($build.method | left(13)), (.level | right(5)), (.spheres | right(8)), (.certified_max_fraction | percent(3) | right(10)),
   (.sampled_max_fraction | percent(3) | right(9)), (.sampled_rms_fraction | percent(3) | right(8)),
   (.uncovered_area_fraction | percent(3) | right(9)), (.wasted_volume_fraction | percent(1) | right(9)),
   (if .level == $build.levels[0].level then ($build.build_cpu_s | fixed(2) | right(9)), ($build.peak_rss_mb | fixed(0) | right(6))
    else empty end)] | join(" ");
def fit_table:
  "== \(.[0].model)",
  "method        level  spheres  certified   sampled          uncovered    wasted     build   peak",
  "                                  max %     max %    rms %    area %  volume %     CPU s     MB",
  (.[] | . as $build | .levels[] | fit_line($build)), "";

def cell($ours; $theirs): "\($ours | fixed(2) | right(6)) (\($theirs | fixed(2) | right(5)))";
def ratio_line:
  ("\(.[0].first)/\(.[0].second)" | left(18)) + (map(cell(.sampled_max; .thesis_max) + cell(.sampled_rms; .thesis_rms)) | join(" "));
def ratio_table:
  "== Thesis, table \(.[0].table), \(.[0].model): how many times smaller the second method's error is; sampled, (thesis's)",
  "                  level 1                     level 2                     level 3",
  "                     max           rms           max           rms           max           rms",
  (range(0; length; 3) as $i | .[$i:$i + 3] | ratio_line), "";  # three levels a row, as in thesis.tsv

# The groups of equal `key`, in the order they come.
def grouped(key): . as $all | reduce map(key)[] as $k ([]; if index([$k]) then . else . + [$k] end)
  | map(. as $k | $all | map(select(key == $k)));

(.builds | grouped(.model)[] | fit_table), (.ratios | grouped(.table)[] | ratio_table)
