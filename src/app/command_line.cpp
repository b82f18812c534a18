#include "app/command_line.hpp"

#include <algorithm>

namespace livebed::app {
namespace {

/// CLI11 adds its checks to the type: TEXT:{livebed,mbs2d} takes one of two words, INT:INT in [1 - 65535] a number.
Argument make_argument(const CLI::Option& option) {
  Argument a;
  for (const std::string& name : option.get_snames()) a.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) a.names.push_back("--" + name);
  a.says = option.get_description();
  a.start = option.get_default_str();
  a.environment = option.get_envname();
  a.required = option.get_required();
  a.many = option.get_items_expected_max() > 1;
  if (option.get_items_expected_max() == 0) return a;  // a flag
  const std::string type = option.get_type_name();
  const std::size_t check = type.find(':'), open = type.find('{'), close = type.rfind('}');
  a.value = option.get_positional() ? option.get_name(true) : type.substr(0, check);
  if (open != std::string::npos && close != std::string::npos)
    a.choices = CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
  return a;
}

Verb make_verb(const CLI::App& app, const std::string& path) {
  Verb verb{path, app.get_description(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options())
    (option->nonpositional() ? verb.options : verb.positionals).push_back(make_argument(*option));
  for (const CLI::App* below : app.get_subcommands(nullptr))
    verb.verbs.push_back(make_verb(*below, path.empty() ? below->get_name() : path + " " + below->get_name()));
  return verb;
}

}  // namespace

Verb describe(const CLI::App& program) { return make_verb(program, ""); }

std::vector<const Verb*> flattened(const Verb& verb) {
  std::vector<const Verb*> all{&verb};
  for (const Verb& below : verb.verbs) {
    const std::vector<const Verb*> more = flattened(below);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace livebed::app
