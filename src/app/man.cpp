#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_line.hpp"
#include "app/verbs.hpp"
#include "base/version.hpp"

/// The man page, printed by the program that it describes, from its own command line (mdoc, as mandoc and groff read).
namespace livebed::app {
namespace {

/// Text as mdoc takes it: no line is a command, each sentence begins one, a backslash and a hyphen are what they look
/// like.
std::string plain(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == ' ' && out.ends_with('.'))
      out += '\n';
    else
      out += c;
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string name_of(const Argument& option) {
  std::string out;
  for (const std::string& name : option.names)
    out += fmt::format("{}Fl {}", out.empty() ? "" : " , ", plain(name.substr(1)));
  if (option.names.empty()) return "Ar " + option.value + (option.many ? " ..." : "");
  return option.value.empty() ? out : out + " Ar " + option.value;
}

std::string items(const std::vector<Argument>& arguments) {
  std::string text;
  for (const Argument& a : arguments) {
    std::string says = a.says;
    if (!a.choices.empty()) says += fmt::format(": {}", fmt::join(a.choices, ", "));
    if (!a.start.empty()) says += fmt::format(" ({} when not given)", a.start);
    if (a.required && !a.names.empty()) says += "; required";
    if (!a.environment.empty()) says += fmt::format("; the variable {} sets it, too", a.environment);
    text += fmt::format(".It {}\n{}\n", name_of(a), plain(says));
  }
  return text.empty() ? "" : ".Bl -tag -width Ds -compact\n" + text + ".El\n";
}

/// The synopsis and the arguments of a verb; -h is the same everywhere and told once.
std::string section(const Verb& verb) {
  std::string head = fmt::format(".Ss {}\n{}{}\n.Pp\n.Nm livebed\n.Cm {}\n", verb.path, plain(verb.says),
                                 verb.says.ends_with('.') ? "" : ".", verb.path);
  std::vector<Argument> all = verb.positionals;
  for (const Argument& option : verb.options)
    if (option.names.front() != "-h") all.push_back(option);
  for (const Argument& a : all) head += fmt::format(".{}{}\n", a.required ? "" : "Op ", name_of(a));
  return head + (all.empty() ? "" : ".Pp\n" + items(all));
}

std::string man_page(const Verb& program) {
  std::string text = fmt::format(R"(.Dd $Mdocdate$
.Dt LIVEBED 1
.Os livebed {}
.Sh NAME
.Nm livebed
.Nd scour of a sand bed under a pipeline, grain by grain
.Sh SYNOPSIS
.Nm
.Op Ar option ...
.Ar verb
.Op Ar argument ...
.Sh DESCRIPTION
{}
A case is a TOML file that names only what differs from the defaults;
.Ic livebed keys
lists every key.
A run leaves its results in a folder of its own.
.Pp
These options go before or after any verb:
.Pp
{}.Sh VERBS
)",
                                 base::version(), plain(program.says), items(program.options));
  for (const Verb* verb : flattened(program))
    if (!verb->path.empty() && verb->verbs.empty()) text += section(*verb);
  return text + R"(.Sh ENVIRONMENT
.Bl -tag -width Ds
.It Ev XDG_CACHE_HOME
Packed beds are kept below it, in
.Pa livebed ;
.Pa ~/.cache
when it is not set.
.El
.Sh EXIT STATUS
.Bl -tag -width 128+n -compact
.It 0
done
.It 1
internal error
.It 2
command line
.It 3
invalid case
.It 4
the computation diverged
.It 5
input or output
.It 6
stopped by a limit
.It 7
a comparison outside its tolerance
.It 128+n
signal n, after a checkpoint
.El
.Sh EXAMPLES
.Dl livebed new quick \-\-out my\-case.toml
.Dl livebed check my\-case.toml
.Dl livebed run my\-case.toml \-\-out runs/first
.Dl livebed report runs/first
)";
}

}  // namespace

void add_man(CLI::App& app, Action& chosen) {
  CLI::App* verb = app.add_subcommand("man", "print the man page");
  verb->callback([&app, &chosen] {
    chosen = [&app] {
      fmt::print("{}", man_page(describe(app)));
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
