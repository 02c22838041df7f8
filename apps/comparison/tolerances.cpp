// tolerances.cpp: tolerances against rows.
#include "apps/comparison/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace wedge {
namespace {

using Names = std::array<std::string, Tolerance::keys.size()>;

/// In the order of Tolerance::keys.
Names names_of(const ComparisonRow& row) {
  return {name_of(row.kind), row.moment, row.region, row.quantity, name_of(row.measure)};
}

bool is_about(const Tolerance& tolerance, const Names& names) {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!fits(tolerance.patterns[k], names[k])) return false;
  return true;
}

/// "" when `value` is within the bound. What is not known is not within.
std::string breach(const char* what, double value, const std::optional<double>& bound) {
  if (!bound || std::abs(value) <= *bound) return "";
  if (std::isnan(value)) return std::string(what) + " is not known";
  return std::string(what) + " " + short_number(std::abs(value)) + " is above " + short_number(*bound);
}

/// The first key whose pattern no row fits, and what it may have meant.
std::string remedy(const Tolerance& tolerance, const std::vector<ComparisonRow>& rows) {
  for (std::size_t k = 0; k < Tolerance::keys.size(); ++k) {
    std::set<std::string> words;
    for (const ComparisonRow& row : rows) words.insert(names_of(row)[k]);
    if (std::any_of(words.begin(), words.end(),
                    [&](const auto& word) { return fits(tolerance.patterns[k], word); }))
      continue;
    return std::string(Tolerance::keys[k]) + " = \"" + tolerance.patterns[k] +
           "\": " + suggestion(tolerance.patterns[k], {words.begin(), words.end()});
  }
  return "no row has all of these names together; `wedge compare --csv FILE` lists them";
}

}  // namespace

Judgement judge(const std::vector<ComparisonRow>& rows, const ToleranceFile& file) {
  Diagnostics diagnostics(file.path, file.text, {});
  Judgement judgement;
  std::set<const ComparisonRow*> judged;
  for (const Tolerance& tolerance : file.tolerances) {
    bool about_any = false;
    for (const ComparisonRow& row : rows) {
      if (!is_about(tolerance, names_of(row))) continue;
      about_any = true;
      judged.insert(&row);
      for (const std::string& says : {breach("absolute", row.value, tolerance.absolute),
                                      breach("relative", row.relative, tolerance.relative)})
        if (!says.empty()) judgement.breaches.push_back({&row, says});
    }
    if (!about_any)
      diagnostics.error(tolerance.place, "this tolerance fits no row of the comparison", remedy(tolerance, rows));
  }
  diagnostics.throw_if_wrong();
  judgement.judged = judged.size();
  return judgement;
}

}  // namespace wedge
