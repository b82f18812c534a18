#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/vtk.hpp"

/// The container of VTK's XML files: elements with zlib-compressed arrays in base64.  Other files of VTK have them in
/// one raw block at the end, which readers of VTK with an expat of 2024 on no longer find (Debian 12's among them).
namespace livebed::io {

/// The <DataArray ...> element of an array.  extra: further attributes.
std::string element(const DataArray& array, const std::string& extra = "");
/// The whole file: type is VTK's name of the data set, body the XML inside <VTKFile>.
std::string xml_file(std::string_view type, std::string_view body);

/// Finds elements and arrays in a file made by the above, or by versions of this program that wrote a raw block.
class XmlReader {
public:
  XmlReader(const Path& path, std::string_view type);

  /// Attributes of the first element of this name; Fault when missing.
  std::map<std::string, std::string> attributes(std::string_view element) const;
  /// All arrays between <section ...> and </section>; empty when the section is missing.
  std::vector<DataArray> arrays(std::string_view section) const;
  /// The only array of a section, or the one of this name.
  DataArray array(std::string_view section, std::string_view name) const;

private:
  [[noreturn]] void fault(const std::string& what) const;
  DataArray decode(const std::map<std::string, std::string>& attributes, std::string_view content) const;
  /// Head and blocks of an array as bytes; what follows them does not matter.
  std::string packed_bytes(const std::map<std::string, std::string>& attributes, std::string_view content) const;

  Path path_;
  std::string bytes_;
  std::string_view xml_;    ///< the whole file, or what is before its raw block
  std::string_view block_;  ///< behind the underscore of that block
};

}  // namespace livebed::io
