#include "tests/support/evidence.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace brisance::evidence {
namespace {

void write_row(std::string const& table, std::string const& head, std::string const& row) {
  char const* folder = std::getenv("BRISANCE_EVIDENCE");
  std::string const path = folder ? folder : "evidence";
  mkdir(path.c_str(), 0777);
  int const file = open((path + "/" + table).c_str(), O_CREAT | O_RDWR | O_APPEND, 0666);
  if (file < 0) return;
  flock(file, LOCK_EX);
  std::string const text = (lseek(file, 0, SEEK_END) == 0 ? head : "") + row;
  if (write(file, text.data(), text.size()) < 0) std::perror(table.c_str());
  flock(file, LOCK_UN);
  close(file);
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x + 0.0);  // -0 reads as 0
  return text;
}

/// A field of the table: commas would end it.
std::string field(std::string text) {
  for (char& c : text)
    if (c == ',') c = ';';
  return text;
}

bool record(std::string const& id, std::string const& name, std::string const& variant, std::string const& quantity,
            double expected, double got, std::string const& tolerance, bool ok) {
  write_row("verification.csv", "id,case,variant,quantity,expected,got,tolerance,verdict\n",
            id + "," + field(name) + "," + field(variant) + "," + field(quantity) + "," + number(expected) + "," +
                number(got) + "," + tolerance + "," + (ok ? "pass" : "fail") + "\n");
  if (!ok)
    std::printf("%s %s [%s] %s: expected %.9g (%s), got %.9g\n", id.c_str(), name.c_str(), variant.c_str(),
                quantity.c_str(), expected, tolerance.c_str(), got);
  return ok;
}

}  // namespace

bool at_most(std::string const& id, std::string const& name, std::string const& variant, std::string const& quantity,
             double got, double limit) {
  return record(id, name, variant, quantity, limit, got, "at most", std::isfinite(got) && got <= limit);
}

bool near(std::string const& id, std::string const& name, std::string const& variant, std::string const& quantity,
          double got, double expected, double tolerance) {
  return record(id, name, variant, quantity, expected, got, number(tolerance), std::abs(got - expected) <= tolerance);
}

bool endured(std::string const& id, std::string const& variant, bool ok, Endurance const& x) {
  write_row("stability.csv", "id,variant,verdict,density_min,pressure_min,conservation,fallback_faces,retries\n",
            id + "," + field(variant) + "," + (ok ? "pass" : "fail") + "," + number(x.density_min) + "," +
                number(x.pressure_min) + "," + number(x.conservation) + "," + std::to_string(x.fallback_faces) + "," +
                std::to_string(x.retries) + "\n");
  return ok;
}

bool full() {
  char const* flag = std::getenv("BRISANCE_FULL");
  return flag && flag[0] == '1';
}

}  // namespace brisance::evidence
