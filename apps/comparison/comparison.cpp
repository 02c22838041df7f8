// comparison.cpp: from quantities to rows: value, interval, yardstick, verdict.
#include "apps/comparison/comparison.hpp"

#include <cmath>
#include <limits>

#include "io/tables/csv.hpp"

namespace wedge {
namespace {

/// value / scale, where 0 of 0 is 0.
double in_parts_of(double value, double scale) {
  if (value == 0) return 0;
  return scale > 0 ? value / scale : std::numeric_limits<double>::quiet_NaN();
}

bool outside(double value, Measure measure, const Yardstick& y) {
  if (measure == Measure::difference) return value < y.low || value > y.high;
  return value > y.high;
}

/// Whether n and m equal things, put in any order, come to stand apart, the n before the m, so rarely that chance
/// is no reason: one of C(n + m, m) orders, 5 % or less.
bool apart(std::size_t n, std::size_t m) {
  double orders = 1;
  for (std::size_t k = 1; k <= m && orders < 20; ++k) orders *= static_cast<double>(n + k) / static_cast<double>(k);
  return orders > 19.5;
}

/// Rounding alone is no difference: two runs of equal numbers must not be told apart by the order of a sum.
bool is_rounding(double value, double scale) { return std::abs(value) <= 1e-12 * scale; }

/// Against a yardstick of no width, that of wedges which all agree, what the interval says decides: it knows more,
/// the scatter of the compared runs. Where that has no width either, only numbers are left.
bool beyond_agreement(const ComparisonRow& row, double scale) {
  if (!(row.interval.low > 0 || row.interval.high < 0)) return false;
  return !is_rounding(row.interval.high - row.interval.low, scale) ||
         apart(row.yardstick.pieces, row.compared_runs);
}

bool is_beyond(const ComparisonRow& row, double scale) {
  if (!outside(row.value, row.measure, row.yardstick) || is_rounding(row.value, scale)) return false;
  return !is_rounding(row.yardstick.high - row.yardstick.low, scale) || beyond_agreement(row, scale);
}

ComparisonRow row_of(const Observable& o, Measure measure, const Design& design) {
  const Pool reference = pool_of(o.reference), compared = pool_of(o.compared);
  Magnitude first{reference.value[0], std::abs(reference.value[0])}, second{compared.value[0], 0};
  if (o.kind == Kind::distribution) {
    first = distribution_magnitude(o.bins, reference);
    second = distribution_magnitude(o.bins, compared);
  } else if (o.kind != Kind::scalar) {
    first = field_magnitude(reference);
    second = field_magnitude(compared);
  }
  if (measure == Measure::kolmogorov_smirnov) first.scale = 1;
  ComparisonRow row;
  row.kind = o.kind;
  row.moment = o.moment;
  row.region = o.region;
  row.quantity = o.quantity;
  row.unit = measure == Measure::kolmogorov_smirnov ? "-" : o.unit;
  row.measure = measure;
  row.reference = first.mean;
  row.compared = second.mean;
  row.value = distance(measure, o.bins, reference, compared);
  row.interval = confidence(o, measure, design);
  row.relative = in_parts_of(row.value, first.scale);
  row.yardstick = yardstick(o, measure, design);
  row.reference_runs = o.reference.size();
  row.compared_runs = o.compared.size();
  row.beyond = is_beyond(row, first.scale);
  return row;
}

}  // namespace

const char* name_of(Kind kind) {
  const char* const names[] = {"scalar", "distribution", "profile", "map"};
  return names[static_cast<int>(kind)];
}
const char* name_of(Measure measure) {
  const char* const names[] = {"difference", "wasserstein", "ks", "rms"};
  return names[static_cast<int>(measure)];
}
const char* name_of(Basis basis) {
  const char* const names[] = {"seeds", "wedges", "intervals", "none"};
  return names[static_cast<int>(basis)];
}

std::vector<ComparisonRow> compare(const Observable& o, const Design& design) {
  if (o.kind == Kind::scalar) return {row_of(o, Measure::difference, design)};
  if (o.kind != Kind::distribution) return {row_of(o, Measure::rms, design)};
  return {row_of(o, Measure::wasserstein, design), row_of(o, Measure::kolmogorov_smirnov, design)};
}

std::vector<ComparisonRow> compare(const RunSets& sets, const std::string& moment) {
  const Design design = design_of(sets);
  std::vector<ComparisonRow> rows;
  for (const Observable& o : observables(sets, moment))
    for (ComparisonRow& row : compare(o, design)) rows.push_back(std::move(row));
  return rows;
}

std::string comparison_csv(const std::vector<ComparisonRow>& rows) {
  std::string text =
      "kind,moment,region,quantity,unit,measure,reference,compared,value,low,high,relative,yardstick,yardstick_low,"
      "yardstick_high,beyond,reference_runs,compared_runs,bootstrap\n";
  for (const ComparisonRow& row : rows) {
    text += name_of(row.kind);
    for (const std::string& word : {row.moment, row.region, row.quantity, row.unit}) text += ',' + csv_quoted(word);
    text += std::string(",") + name_of(row.measure);
    const double beyond = std::isfinite(row.yardstick.high) ? (row.beyond ? 1 : 0) : std::nan("");
    for (const double number : {row.reference, row.compared, row.value, row.interval.low, row.interval.high,
                                row.relative, row.yardstick.median, row.yardstick.low, row.yardstick.high, beyond,
                                static_cast<double>(row.reference_runs), static_cast<double>(row.compared_runs)}) {
      text += ',' + (std::isnan(number) ? "nan" : number_text(number));  // whatever the sign of a nan
    }
    text += std::string(",") + name_of(row.interval.basis) + '\n';
  }
  return text;
}

}  // namespace wedge
