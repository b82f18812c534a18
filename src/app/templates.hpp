#pragma once
#include <string>
#include <vector>

/// The cases under cases/, built into the program so that it needs no folder beside it.
namespace livebed::app {

struct Template {
  std::string name;  ///< cases/NAME/case.toml is NAME, cases/NAME/deep.toml is NAME/deep
  std::string text;
};

const std::vector<Template>& templates();

}  // namespace livebed::app
