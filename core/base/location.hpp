// Where in a scene file something was written, so that every later message can point at it.
#pragma once
#include <string>

namespace brisance {

/// A place in a text file. Line 0: a place without lines, such as an override of the command line.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  /// "blast.toml:6:9", or only the file when there is no line.
  std::string text() const {
    return line > 0 ? file + ":" + std::to_string(line) + ":" + std::to_string(column) : file;
  }
};

}  // namespace brisance
