#pragma once
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "case/schema.hpp"

/// How the rows of the schema are made, and the tables they come in.
namespace livebed::casefile {

/// Path from a Case to one of its numbers: at(&Case::flow, &flow::Params::density).
template <class... Members>
auto at(Members... members) {
  return [=](auto& c) -> auto& { return (c.*....*members); };
}

/// A row whose value is stored as Stored (double, integer, bool, text) at the end of a path.
template <class Stored, class Path>
Row row(std::string name, Type type, Path path) {
  Row r;
  r.name = std::move(name);
  r.type = type;
  r.get = [path](const Case& c) { return Value(static_cast<Stored>(path(c))); };
  r.set = [path](Case& c, const Value& v) {
    using Member = std::remove_reference_t<decltype(path(c))>;
    path(c) = static_cast<Member>(std::get<Stored>(v));
  };
  return r;
}

template <class Path>
Row real(std::string name, std::string unit, Path path) {
  Row r = row<double>(std::move(name), Type::real, path);
  r.unit = std::move(unit);
  return r;
}
template <class Path>
Row integer(std::string name, Path path) {
  return row<long long>(std::move(name), Type::integer, path);
}
template <class Path>
Row flag(std::string name, Path path) {
  return row<bool>(std::move(name), Type::flag, path);
}
template <class Path>
Row text(std::string name, Path path) {
  return row<std::string>(std::move(name), Type::text, path);
}
/// A choice between words, each standing for one value of an enumeration.
template <class Enum, class Path>
Row word(std::string name, Path path, std::vector<std::pair<std::string, Enum>> meanings) {
  Row r;
  r.name = std::move(name);
  r.type = Type::word;
  for (const auto& [allowed, value] : meanings) r.words.push_back(allowed);
  r.get = [=](const Case& c) {
    for (const auto& [allowed, value] : meanings)
      if (path(c) == value) return Value(allowed);
    return Value(std::string("?"));  // an enumerator without a word: the schema's test fails on it
  };
  r.set = [=](Case& c, const Value& v) {
    for (const auto& [allowed, value] : meanings)
      if (std::get<std::string>(v) == allowed) path(c) = value;
  };
  return r;
}
/// A number that follows from others.
template <class Path>
Row derived(std::string name, std::string unit, Path path) {
  Row r = real(std::move(name), std::move(unit), path);
  r.derived = true;
  return r;
}

void add_general(std::vector<Row>& rows);
void add_mesh(std::vector<Row>& rows);
void add_pipe(std::vector<Row>& rows);
void add_flow(std::vector<Row>& rows);
void add_current(std::vector<Row>& rows);
void add_bed(std::vector<Row>& rows);
void add_grains(std::vector<Row>& rows);
void add_contact(std::vector<Row>& rows);
void add_coupling(std::vector<Row>& rows);
void add_time(std::vector<Row>& rows);
void add_output(std::vector<Row>& rows);

}  // namespace livebed::casefile
