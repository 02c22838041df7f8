// results.cpp: tables of an analysis as text.
#include "apps/analysis/results.hpp"

#include <charconv>
#include <cmath>

#include "io/tables/csv.hpp"

namespace wedge {
namespace {

/// Appends ",value" with so many digits, or "nan".
void append_field(std::string& text, double value, int digits = 5) {
  text += ',';
  if (!std::isfinite(value)) {
    text += "nan";
    return;
  }
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value == 0 ? 0.0 : value, std::chars_format::general, digits);
  text.append(buffer, end.ptr);
}

/// "moment,part"
std::string place(const MomentResult& result, const PartResult& part) {
  return csv_quoted(result.moment.name) + "," + name_of(part.sums->part().id);
}

}  // namespace

Zone zone_of(double packing, double vr, double vz, double plug_speed) {
  if (!(packing >= 0.3) || !(plug_speed > 0)) return Zone::none;
  if (-vz < 0.1 * plug_speed) return Zone::stagnant;
  const bool even = -vz >= 0.5 * plug_speed && -vz <= 1.5 * plug_speed && std::abs(vr) <= 0.1 * std::abs(vz);
  return even ? Zone::plug : Zone::converging;
}

CellFields cell_fields(const PartSums& sums, int column, int row) {
  const std::size_t cell = sums.grid().cell(column, row);
  const double* f = &sums.fields()[cell * grain_fields];
  const double* s = &sums.stresses()[cell * stress_fields];
  const double frames = sums.frames(), mass = f[field_mass];
  CellFields c;
  c.grains = f[field_count] / frames * sums.grid().volume(column);
  c.packing = f[field_volume] / frames;
  c.cn = f[field_cn] / f[field_count];
  c.cn_near = f[field_cn_near] / f[field_count];
  c.cn_distinct = f[field_cn_distinct] / f[field_count];
  c.velocity = {f[field_mvr] / mass, f[field_mvt] / mass, f[field_mvz] / mass};
  const Vec3 v = c.velocity;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto pressure = [&](StressIndex contact, FieldIndex moving, double mean_square) {
    return sums.has_forces() ? (s[contact] + f[moving] - mass * mean_square) / frames : nan;
  };
  c.prr = pressure(stress_rr, field_mvrvr, v.x * v.x);
  c.ptt = pressure(stress_tt, field_mvtvt, v.y * v.y);
  c.pzz = pressure(stress_zz, field_mvzvz, v.z * v.z);
  c.prz = pressure(stress_rz, field_mvrvz, v.x * v.z);
  return c;
}

std::vector<double> zone_volumes(const PartSums& sums, double plug_speed) {
  std::vector<double> volumes(3, 0);
  const FieldGrid& grid = sums.grid();
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const CellFields c = cell_fields(sums, column, row);
      const Zone zone = zone_of(c.packing, c.velocity.x, c.velocity.z, plug_speed);
      if (zone != Zone::none) volumes[static_cast<std::size_t>(zone) - 1] += grid.volume(column);
    }
  }
  return volumes;
}

std::string scalars_csv(const std::vector<MomentResult>& results) {
  std::string text = "moment,part,quantity,unit,value,low,high\n";
  for (const MomentResult& result : results) {
    for (const PartResult& part : result.parts) {
      for (const Scalar& scalar : part.scalars) {
        text += place(result, part) + "," + scalar.quantity->name + "," + scalar.quantity->unit;
        for (const double value : {scalar.estimate.value, scalar.estimate.low, scalar.estimate.high})
          append_field(text, value);
        text += '\n';
      }
    }
  }
  return text;
}

std::string distributions_csv(const std::vector<MomentResult>& results) {
  std::string text = "moment,part,region,quantity,unit,scale,step,first,counts\n";
  for (const MomentResult& result : results) {
    for (const PartResult& part : result.parts) {
      const PartSums& sums = *part.sums;
      for (std::size_t r = 0; r < sums.part().regions.size(); ++r) {
        for (std::size_t k = 0; k < sums.kinds().size(); ++k) {
          const auto& counts = sums.histogram(r, k).counts();
          if (counts.empty()) continue;
          const DistributionKind& kind = sums.kinds()[k];
          text += place(result, part) + "," + name_of(sums.part().regions[r].id) + "," + kind.quantity->name + "," +
                  kind.quantity->unit;
          append_field(text, kind.bins.scale);
          append_field(text, kind.bins.step);
          text += "," + std::to_string(counts.begin()->first);
          std::string row;
          for (int bin = counts.begin()->first; bin <= counts.rbegin()->first; ++bin) {
            const auto found = counts.find(bin);
            append_field(row, found == counts.end() ? 0 : found->second / sums.frames());
          }
          for (char& c : row)
            if (c == ',') c = ' ';
          text += "," + row.substr(1) + "\n";
        }
      }
    }
  }
  return text;
}

std::string radial_csv(const std::vector<MomentResult>& results) {
  std::string text = "moment,part" +
                     headings({"r", "arc", row_weight, "cn", "cn_near", "cn_distinct", "cn_corrected", "vr", "vt",
                               "vz", "speed_spread"}) +
                     "\n";
  for (const MomentResult& result : results) {
    for (const PartResult& part : result.parts) {
      const PartSums& sums = *part.sums;
      for (std::size_t k = 0; k < sums.rings().size(); ++k) {
        const Ring& ring = sums.rings()[k];
        if (!(ring.grains > 0)) continue;
        const double r = (static_cast<double>(k) + 0.5) * sums.ring_width(), n = ring.grains;
        const double cn = ring.cn / n, distinct = ring.cn_distinct / n;
        const Vec3 v{ring.vr / n, ring.vt / n, ring.vz / n};
        text += place(result, part);
        for (const double value :
             {r, sums.arc(r), n / sums.frames() * sums.part().pieces, cn, ring.cn_near / n, distinct,
              distinct * sums.correction(r), v.x, v.y, v.z, std::sqrt(std::max(0.0, ring.squares / n - dot(v, v)))})
          append_field(text, value);
        text += '\n';
      }
    }
  }
  return text;
}

std::string map_csv(const std::vector<MomentResult>& results) {
  constexpr double fewest = 0.05;  // grains: cells with less are left out
  std::string text = "moment,part" +
                     headings({"r", "z", row_weight, "packing", "cn", "cn_near", "cn_distinct", "cn_corrected",
                               "vr", "vt", "vz", "prr", "ptt", "pzz", "prz", "zone"}) +
                     "\n";
  for (const MomentResult& result : results) {
    for (const PartResult& part : result.parts) {
      const FieldGrid& grid = part.sums->grid();
      for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
          const CellFields c = cell_fields(*part.sums, column, row);
          if (!(c.grains >= fewest)) continue;
          text += place(result, part);
          const double r = grid.across(column), corrected = c.cn_distinct * part.sums->correction(std::abs(r));
          for (const double value :
               {r, grid.up(row), c.grains, c.packing, c.cn, c.cn_near, c.cn_distinct, corrected, c.velocity.x,
                c.velocity.y, c.velocity.z, c.prr, c.ptt, c.pzz, c.prz})
            append_field(text, value, 4);
          text +=
              "," +
              std::to_string(static_cast<int>(zone_of(c.packing, c.velocity.x, c.velocity.z, part.plug_speed))) +
              "\n";
        }
      }
    }
  }
  return text;
}

std::string flow_csv(const AnalysedRun& run, const std::vector<Crossing>& crossings, double until) {
  constexpr double every = 0.05;  // s
  std::string text = headings({"time", "out", "rate"}).substr(1) + "\n";
  const std::optional<double> opening = run.opened();
  if (!opening) return text;
  std::size_t k = 0;
  double out = 0;
  while (k < crossings.size() && crossings[k].time <= *opening) ++k;
  const double slack = 0.02 * every;  // stages begin and end in the first step at or after their time
  for (int row = 1; *opening + row * every <= until + slack; ++row) {
    const double before = out;
    while (k < crossings.size() && crossings[k].time <= *opening + row * every) out += crossings[k++].weight;
    text += number_text(std::round(100 * row * every) / 100);
    append_field(text, out);
    append_field(text, (out - before) / every);
    text += '\n';
  }
  return text;
}

void append_slice(std::string& grains, std::string& lines, const std::string& moment, const SlicePicture& picture) {
  if (grains.empty()) grains = "moment" + headings({"x", "y", "z", "radius", "cn", "vr", "vz", "layer"}) + "\n";
  if (lines.empty()) lines = "moment" + headings({"x1", "z1", "x2", "z2", "load"}) + "\n";
  for (const PictureGrain& p : picture.grains) {
    grains += csv_quoted(moment);
    for (const double value :
         {p.position.x, p.position.y, p.position.z, p.grain->radius, static_cast<double>(p.grain->cn),
          p.grain->velocity.x, p.grain->velocity.z, static_cast<double>(p.grain->layer)})
      append_field(grains, value);
    grains += '\n';
  }
  for (const PictureLine& line : picture.lines) {
    lines += csv_quoted(moment);
    for (const double value : {line.from.x, line.from.z, line.to.x, line.to.z, line.load})
      append_field(lines, value);
    lines += '\n';
  }
}

void append_cut(std::string& text, const std::string& moment, const std::vector<PictureGrain>& grains) {
  if (text.empty()) text = "moment" + headings({"x", "y", "z", "radius", "cn", "vz", "layer"}) + "\n";
  for (const PictureGrain& p : grains) {
    text += csv_quoted(moment);
    for (const double value :
         {p.position.x, p.position.y, p.position.z, p.grain->radius, static_cast<double>(p.grain->cn),
          p.grain->velocity.z, static_cast<double>(p.grain->layer)})
      append_field(text, value);
    text += '\n';
  }
}

}  // namespace wedge
