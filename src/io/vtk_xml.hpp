#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/vtk.hpp"

/// The container of VTK's XML files: elements whose arrays live in one appended, zlib-compressed block.
namespace livebed::io {

/// Collects the appended block while the XML in front of it is written.
class AppendedWriter {
public:
  /// Compresses the array, appends it and returns its <DataArray .../> element.  extra: further attributes.
  std::string element(const DataArray& array, const std::string& extra = "");
  /// The whole file: type is VTK's name of the data set, body the XML inside <VTKFile>.
  std::string file(std::string_view type, std::string_view body) const;

private:
  std::string block_;
};

/// Finds elements and arrays in a file made by AppendedWriter.
class AppendedReader {
public:
  AppendedReader(const Path& path, std::string_view type);

  /// Attributes of the first element of this name; Fault when missing.
  std::map<std::string, std::string> attributes(std::string_view element) const;
  /// All arrays between <section ...> and </section>; empty when the section is missing.
  std::vector<DataArray> arrays(std::string_view section) const;
  /// The only array of a section, or the one of this name.
  DataArray array(std::string_view section, std::string_view name) const;

private:
  [[noreturn]] void fault(const std::string& what) const;
  DataArray decode(const std::map<std::string, std::string>& attributes) const;

  Path path_;
  std::string bytes_;
  std::string_view xml_;    ///< up to the appended block
  std::string_view block_;  ///< behind its underscore
};

}  // namespace livebed::io
