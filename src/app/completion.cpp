#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

#include "app/command_line.hpp"
#include "app/verbs.hpp"
#include "case/schema.hpp"

/// Completion for shells.  The scripts are printed by the program that they complete, from its own command line and
/// from its own keys.
namespace livebed::app {
namespace {

/// What --set takes: every key that a case may give, with the sign that follows it.
std::vector<std::string> settable_keys() {
  std::vector<std::string> keys;
  for (const casefile::Row& row : casefile::schema())
    if (!row.derived) keys.push_back(row.name + "=");
  return keys;
}

bool takes_keys(const Argument& option) {
  return std::find(option.names.begin(), option.names.end(), "--set") != option.names.end();
}

std::string last_word(const std::string& path) { return path.substr(path.rfind(' ') + 1); }

/// Text between single quotes, for any of the three shells.
std::string quoted(const std::string& text, std::string_view quote_inside) {
  std::string out = "'";
  for (char c : text) c == '\'' ? out += quote_inside : out += c;
  return out + "'";
}
std::string in_sh(const std::string& text) { return quoted(text, "'\\''"); }
std::string in_fish(const std::string& text) { return quoted(text, "\\'"); }

/// What may follow a verb beside options: the verbs below it, or the words that its positional arguments take.
std::vector<std::string> names_after(const Verb& verb) {
  std::vector<std::string> names;
  for (const Verb& below : verb.verbs) names.push_back(last_word(below.path));
  for (const Argument& positional : verb.positionals)
    names.insert(names.end(), positional.choices.begin(), positional.choices.end());
  return names;
}

/// The options of a verb and those of the program, which go anywhere.
std::vector<std::string> options_after(const Verb& program, const Verb& verb) {
  std::vector<std::string> words;
  for (const Verb* source : {&verb, &program})
    for (const Argument& option : source->options)
      for (const std::string& name : option.names)
        if (std::find(words.begin(), words.end(), name) == words.end()) words.push_back(name);
  return words;
}

std::string bash(const Verb& program) {
  std::string verbs, values, words;
  for (const Verb* verb : flattened(program)) {
    if (!verb->path.empty()) {
      const std::string::size_type gap = verb->path.rfind(' ');
      const std::string above = gap == std::string::npos ? "" : verb->path.substr(0, gap);
      verbs += fmt::format("      \"{}:{}\") verb='{}' ;;\n", above, last_word(verb->path), verb->path);
    }
    for (const Argument& option : verb->options) {
      if (option.value.empty()) continue;
      std::string patterns;
      for (const std::string& name : option.names)
        patterns +=
            fmt::format("{}{}:{}", patterns.empty() ? "" : "|", verb->path.empty() ? "*" : in_sh(verb->path), name);
      if (takes_keys(option))
        values += fmt::format(
            "    {}) compopt -o nospace; COMPREPLY=($(compgen -W \"$keys\" -- \"$cur\")); return ;;\n", patterns);
      else if (!option.choices.empty())
        values += fmt::format("    {}) COMPREPLY=($(compgen -W '{}' -- \"$cur\")); return ;;\n", patterns,
                              fmt::join(option.choices, " "));
      else
        values += fmt::format("    {}) return ;;\n", patterns);
    }
    words += fmt::format("    {}) names='{}' options='{}' ;;\n", in_sh(verb->path), fmt::join(names_after(*verb), " "),
                         fmt::join(options_after(program, *verb), " "));
  }
  return fmt::format(R"(# bash completion of livebed, printed by `livebed completion bash`
_livebed() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD - 1]}} verb='' word names='' options=''
  local keys='{}'
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD - 1}}"; do
    case "$verb:$word" in
{}    esac
  done
  case "$verb:$prev" in
{}  esac
  case "$verb" in
{}  esac
  # Files are left to the shell: COMPREPLY stays empty then.
  [[ $cur == -* ]] && names=$options
  COMPREPLY=($(compgen -W "$names" -- "$cur"))
}}
complete -o bashdefault -o default -F _livebed livebed
)",
                     fmt::join(settable_keys(), " "), verbs, values, words);
}

/// One argument of zsh's _arguments.
std::string zsh_argument(const Argument& a) {
  std::string says = a.says, action;
  for (const char* special : {"\\", "[", "]", ":"})
    for (std::size_t at = says.find(special); at != std::string::npos; at = says.find(special, at + 2))
      says.insert(at, "\\");
  if (takes_keys(a))
    action = fmt::format("compadd -S \"\" {}", fmt::join(settable_keys(), " "));
  else
    action = a.choices.empty() ? "_files" : fmt::format("({})", fmt::join(a.choices, " "));
  if (a.names.empty()) return in_sh(fmt::format("{}:{}:{}", a.many ? "*" : "", says, action));
  std::string all;
  for (const std::string& name : a.names)
    all += fmt::format(" {}", in_sh(fmt::format("{}{}[{}]{}", a.many ? "*" : "", name, says,
                                                a.value.empty() ? "" : fmt::format(":{}:{}", a.value, action))));
  return all.substr(1);
}

/// The arguments of a verb; where verbs follow, their names and then their own arguments.
std::string zsh_function(const Verb& verb) {
  std::string name = "_livebed", arguments, cases;
  if (!verb.path.empty()) name += "_" + verb.path;
  std::replace(name.begin(), name.end(), ' ', '_');
  for (const Argument& option : verb.options) arguments += " \\\n    " + zsh_argument(option);
  for (const Argument& positional : verb.positionals) arguments += " \\\n    " + zsh_argument(positional);
  if (verb.verbs.empty()) return fmt::format("{}() {{\n  _arguments -s{}\n}}\n", name, arguments);
  std::string verbs;
  for (const Verb& below : verb.verbs) {
    const std::string word = last_word(below.path);
    verbs += fmt::format(" {}", in_sh(word + ":" + below.says));
    cases += fmt::format("      {}) {}_{} ;;\n", word, name, word);
  }
  return fmt::format(R"({}() {{
  local context state state_descr line
  typeset -A opt_args
  local -a verbs=({})
  _arguments -C{} \
    '1:verb:->verb' '*::arguments:->rest'
  case $state in
    verb) _describe verb verbs ;;
    rest) case $words[1] in
{}    esac ;;
  esac
}}
)",
                     name, verbs, arguments, cases);
}

std::string zsh(const Verb& program) {
  std::string text = "#compdef livebed\n# zsh completion of livebed, printed by `livebed completion zsh`\n";
  for (const Verb* verb : flattened(program)) text += zsh_function(*verb);
  return text + "_livebed \"$@\"\n";
}

std::string fish(const Verb& program) {
  std::string text = "# fish completion of livebed, printed by `livebed completion fish`\n";
  for (const Verb* verb : flattened(program)) {
    std::string when;
    for (std::size_t from = 0; !verb->path.empty() && from != std::string::npos;) {
      const std::size_t gap = verb->path.find(' ', from);
      when += fmt::format("{}__fish_seen_subcommand_from {}", when.empty() ? "" : "; and ",
                          verb->path.substr(from, gap == std::string::npos ? gap : gap - from));
      from = gap == std::string::npos ? gap : gap + 1;
    }
    std::string below;
    for (const Verb& next : verb->verbs) below += " " + last_word(next.path);
    for (const Verb& next : verb->verbs)
      text += fmt::format(
          "complete -c livebed -f -n {} -a {} -d {}\n",
          in_fish(when.empty() ? "__fish_use_subcommand" : when + "; and not __fish_seen_subcommand_from" + below),
          last_word(next.path), in_fish(next.says));
    for (const Argument& option : verb->options) {
      text += "complete -c livebed";
      if (!when.empty()) text += " -n " + in_fish(when);
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.value.empty()) text += " -r";
      if (takes_keys(option))
        text += fmt::format(" -f -a {}", in_fish(fmt::format("{}", fmt::join(settable_keys(), " "))));
      else if (!option.choices.empty())
        text += fmt::format(" -f -a {}", in_fish(fmt::format("{}", fmt::join(option.choices, " "))));
      text += " -d " + in_fish(option.says) + "\n";
    }
  }
  return text;
}

}  // namespace

void add_completion(CLI::App& app, Action& chosen) {
  auto shell = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("completion", "print the completion script of a shell");
  verb->add_option("SHELL", *shell, "for which shell")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb->callback([shell, &app, &chosen] {
    chosen = [shell, &app] {
      const Verb program = describe(app);
      fmt::print("{}", *shell == "bash" ? bash(program) : *shell == "zsh" ? zsh(program) : fish(program));
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
