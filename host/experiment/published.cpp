#include "experiment/published.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "error.hpp"

namespace kreisel::core {
namespace {

std::optional<PublishedRow::Side> side(const nlohmann::json& row, const char* name) {
  if (!row.contains(name)) return std::nullopt;
  const auto& found = row.at(name);
  return PublishedRow::Side{found.at("variables").get<int>(), found.at("seconds").get<double>()};
}

std::optional<PublishedRow::Inertia> inertia(const nlohmann::json& row) {
  if (!row.contains("inertia")) return std::nullopt;
  using Six = std::array<double, 6>;
  const auto& found = row.at("inertia");
  return PublishedRow::Inertia{found.at("before").get<Six>(), found.at("after").get<Six>()};
}

std::optional<PublishedRow::Standing> standing(const nlohmann::json& row) {
  if (!row.contains("standing")) return std::nullopt;
  const auto& found = row.at("standing");
  return PublishedRow::Standing{found.at("height_percent").get<double>(),
                                found.at("tilt_degrees").get<double>()};
}

std::optional<PublishedRow::Voids> voids(const nlohmann::json& row) {
  if (!row.contains("voids")) return std::nullopt;
  const auto& found = row.at("voids");
  return PublishedRow::Voids{found.at("pieces").get<int>(), found.at("cuts").get<int>()};
}

std::optional<PublishedRow::Nesting> nesting(const nlohmann::json& row) {
  if (!row.contains("nesting")) return std::nullopt;
  const auto& found = row.at("nesting");
  return PublishedRow::Nesting{found.at("triangles").get<int>(), found.at("test_ms").get<double>(),
                               found.at("search_ms").get<double>(), found.at("seconds").get<double>(),
                               found.at("scale").get<double>()};
}

}  // namespace

const PublishedRow* Published::find(const std::string& model, const std::optional<std::array<int, 3>>& grid,
                                    const std::string& problem,
                                    const std::map<std::string, std::string>& settings) const {
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const PublishedRow& row) {
    return row.model == model && (!row.grid || row.grid == grid) &&
           (row.problem.empty() || problem.empty() || row.problem == problem) &&
           std::ranges::includes(settings, row.settings);
  });
  return at == rows.end() ? nullptr : &*at;
}

Published read_published(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("{}: cannot be read, expected published numbers", file.string()));
  try {
    const auto json = nlohmann::json::parse(stream);
    Published published{json.at("source").get<std::string>(), json.at("machine").get<std::string>(), {}};
    for (const auto& row : json.at("rows")) {
      PublishedRow& out = published.rows.emplace_back();
      out.model = row.at("model").get<std::string>();
      if (row.contains("grid")) out.grid = row.at("grid").get<std::array<int, 3>>();
      out.problem = row.value("problem", "");
      out.label = row.value("label", "");
      out.solver = row.value("solver", "");
      out.rayrep = side(row, "rayrep");
      out.voxel = side(row, "voxel");
      if (row.contains("speedup")) out.speedup = row.at("speedup").get<double>();
      if (row.contains("seconds")) out.seconds = row.at("seconds").get<double>();
      out.inertia = inertia(row);
      out.standing = standing(row);
      out.voids = voids(row);
      out.nesting = nesting(row);
      if (row.contains("omega_reduction")) out.omega_reduction = row.at("omega_reduction").get<double>();
      if (row.contains("settings"))
        out.settings = row.at("settings").get<std::map<std::string, std::string>>();
    }
    return published;
  } catch (const nlohmann::json::exception& error) {
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw InputError(
        fmt::format("{}: {}, expected source, machine and rows of published numbers", file.string(), what));
  }
}

}  // namespace kreisel::core
