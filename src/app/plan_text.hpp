#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/sizing.hpp"
#include "case/expected.hpp"

/// What `livebed plan` tells, as text and as JSON.
namespace livebed::app {

struct Plan {
  std::string title;
  casefile::Scene scene;
  std::optional<casefile::Scene> real;  ///< the sand that the grains of the case stand for
  run::Work work;
  run::Speeds speeds;
  run::Prediction prediction;
  double hours = 0;
  int threads = 1;
  std::optional<Size> size;              ///< larger grains, when the case does not fit into the hours
  std::optional<casefile::Scene> model;  ///< the scene with those
  std::vector<std::string> notes;
};

std::string text_of(const Plan& plan);
nlohmann::ordered_json json_of(const Plan& plan);

/// What grains of another size than the sand keep and what they lose, a line each.
std::string kept_and_lost(const casefile::Scene& sand, const casefile::Scene& grains);

}  // namespace livebed::app
