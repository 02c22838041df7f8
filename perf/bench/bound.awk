# bound.awk: how near is a step to the machine's limit? Reads the JSON of bench_limits, then that of bench_passes; prints
# a table for each size of the bed. The bound of a pass is the longest of: its bytes at the bandwidth of the memory
# that holds the bed; its additions and products; its roots and divisions (another unit of the processor). Lists are
# left out. Usage: awk -f bound.awk limits.json passes.json
function rate(name, counter) { return value["median", name, counter] }
/"run_name":/ { split($0, q, "\""); name = q[4] }
/"aggregate_name":/ { split($0, q, "\""); kind = q[4] }
/^ *"[a-z_]+": [-+0-9.e]+,?$/ {
  split($0, q, "\""); number = $2; sub(/,$/, "", number)
  value[kind, name, q[2]] = number + 0
  if (kind == "median" && name ~ /^read\//) { level = name; sub(/_.*/, "", level); read[level] = rate(name, "bytes") ? rate(name, "bytes") : read[level] }
}
function max(a, b) { return a > b ? a : b }
function width(precision) { return precision == "mixed" ? "_float" : "" }
# seconds that a pass needs at least for one grain
function bound(pass, bandwidth, precision,   w, other) {
  w = width(precision)
  other = rate(pass, "roots_each") / rate("arithmetic/root_and_add" w, "numbers") + rate(pass, "divisions_each") / rate("arithmetic/divide_and_add" w, "numbers")
  return max(rate(pass, "bytes_each") / bandwidth, max(rate(pass, "operations_each") / rate("arithmetic/add" w, "numbers"), other))
}
END {
  split("2000 32000 120000", sizes); split("read/L2 read/L3 read/memory", levels); split("double mixed", precisions)
  passes = split("contacts/rolling fold walls move/second_and_first", names)
  print "| grains | precision | contacts: bound, ns | measured | fold | | walls | | move | | step | | bound / measured |"
  print "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
  for (s = 1; s <= 3; ++s) for (p = 1; p <= 2; ++p) {
    least = time = 0; line = "| " sizes[s] " | " precisions[p]
    for (k = 1; k <= passes; ++k) {
      pass = names[k] "/alike/" precisions[p] "/" sizes[s]
      b = bound(pass, read[levels[s]], precisions[p]); t = rate(pass, "each")
      least += b; time += t; line = line sprintf(" | %.1f | %.1f", 1e9 * b, 1e9 * t)
    }
    if (time) print line sprintf(" | %.1f | %.1f | %.0f %% |", 1e9 * least, 1e9 * time, 100 * least / time)
  }
}
