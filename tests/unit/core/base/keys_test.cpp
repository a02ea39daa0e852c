#include "core/base/keys.hpp"

#include <gtest/gtest.h>

#include "parallel/error.hpp"

namespace brisance {
namespace {

struct Scheme {
  int order = 5;
  double cfl = 0.8;
  Location at;
  static void keys(Keys<Scheme>& k) {
    k("order", &Scheme::order, "", "order of the flux").one_of({1, 3, 5});
    k("cfl", &Scheme::cfl, "1", "Courant number").above(0).at_most(0.9);
  }
};

struct Matter {
  double density = 0;
  std::optional<double> modulus;
  static void keys(Keys<Matter>& k) {
    k("density", &Matter::density, "kg/m3", "density").above(0).required();
    k("modulus", &Matter::modulus, "Pa", "stiffness").at_least(0);
  }
};

struct Thing {
  std::string shape = "box";
  Vec3 low{}, spin{};
  std::vector<std::string> marks;
  std::vector<double> lengths;
  std::vector<int> counts;
  std::optional<Vec3> push;
  std::optional<std::string> note;
  std::int64_t seed = 1;
  bool held = false;
  Location at;
  static void keys(Keys<Thing>& k) {
    k("shape", &Thing::shape, "", "shape").one_of({"box", "ball"});
    k("low", &Thing::low, "m", "corner");
    k("spin", &Thing::spin, "1/s", "angular velocity");
    k("marks", &Thing::marks, "", "words");
    k("lengths", &Thing::lengths, "m", "lengths").at_least(0);
    k("counts", &Thing::counts, "", "counts");
    k("push", &Thing::push, "N", "force");
    k("note", &Thing::note, "", "a line");
    k("seed", &Thing::seed, "", "seed");
    k("held", &Thing::held, "", "whether it is held");
  }
};

struct Everything {
  double end_time = 1;
  std::array<Index, 3> cells{1, 1, 1};
  std::optional<Scheme> scheme;
  std::map<std::string, Matter> material;
  std::vector<Thing> thing;
  static void keys(Keys<Everything>& k) {
    k("end_time", &Everything::end_time, "s", "end").above(0);
    k("cells", &Everything::cells, "", "cells").at_least(1);
    k("scheme", &Everything::scheme, "", "the scheme");
    k("material", &Everything::material, "", "materials");
    k("thing", &Everything::thing, "", "things");
  }
};

Everything read(std::string const& text) { return read_keys<Everything>(parse_toml(text, "s.toml")); }

std::string complaint(std::string const& text, std::string const& assignment = "") {
  try {
    Tree tree = parse_toml(text, "s.toml");
    if (!assignment.empty()) apply_override(tree, assignment);
    read_keys<Everything>(tree);
  } catch (Error const& error) {
    EXPECT_EQ(error.kind(), Failure::scene);
    return error.what();
  }
  return "";
}

TEST(Keys, FillStructsOfAllKinds) {
  Everything const e = read(R"(
end_time = "2 ms"
cells = [600, 300]
scheme = { order = 3 }
[material.steel]
density = "7860 kg/m3"
modulus = "210 GPa"
[material."soft foam"]
density = 30
[[thing]]
low = ["1 m", "20 cm"]
spin = [0, 0, "60 rpm"]
marks = ["a", "b"]
lengths = [1, "2 mm", 3.5]
counts = [4, 5]
push = ["1 kN"]
seed = 9000000000
held = true
[[thing]]
shape = "ball"
note = "x")");
  EXPECT_EQ(e.end_time, 2e-3);
  EXPECT_EQ(e.cells, (std::array<Index, 3>{600, 300, 1}));
  ASSERT_TRUE(e.scheme);
  EXPECT_EQ(e.scheme->order, 3);
  EXPECT_EQ(e.scheme->cfl, 0.8);
  EXPECT_EQ(e.material.at("steel").modulus, 210e9);
  EXPECT_FALSE(e.material.at("soft foam").modulus);
  ASSERT_EQ(e.thing.size(), 2u);
  EXPECT_EQ(e.thing[0].low, (Vec3{1, 0.2, 0}));
  EXPECT_DOUBLE_EQ(e.thing[0].spin.z, 6.283185307179586);
  EXPECT_EQ(e.thing[0].marks, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(e.thing[0].lengths, (std::vector<double>{1, 2e-3, 3.5}));
  EXPECT_EQ(e.thing[0].counts, (std::vector<int>{4, 5}));
  EXPECT_EQ(e.thing[0].push, (Vec3{1000, 0, 0}));
  EXPECT_EQ(e.thing[0].seed, 9000000000);
  EXPECT_TRUE(e.thing[0].held);
  EXPECT_EQ(e.thing[1].shape, "ball");
  EXPECT_EQ(e.thing[1].note, "x");
}

TEST(Keys, AbsentSectionIsAnEffectThatIsOff) { EXPECT_FALSE(read("").scheme); }

TEST(Keys, RecordWhereASectionWasWritten) {
  Everything const e = read("end_time = 1\n\n[scheme]\norder = 1\n[[thing]]\n[[thing]]\n");
  EXPECT_EQ(e.scheme->at.text(), "s.toml:3:1");
  EXPECT_EQ(e.thing[1].at.text(), "s.toml:6:1");
}

TEST(Keys, WhatIsWrittenReadsBackBitForBit) {
  Everything e;
  e.end_time = 0.1 + 0.2;
  e.cells = {7, 8, 9};
  e.scheme.emplace().cfl = 1.0 / 3.0;
  e.material["steel"].density = 1e22;
  e.material["a \"b\" c"].density = 5e-324;
  e.material["steel"].modulus = 9223372036854775808.0;
  Thing thing;
  thing.low = {-0.0, 1e-300, 123456789.123456789};
  thing.marks = {"tab\t", "quote\"", "back\\slash", "µ"};
  thing.lengths = {0.1, 1e5};
  thing.push = Vec3{1, 2, 3};
  thing.seed = INT64_MIN + 1;
  e.thing = {thing, Thing{}};
  std::string const text = write_keys(e);
  Everything const back = read(text);
  EXPECT_EQ(write_keys(back), text);
  EXPECT_EQ(back.end_time, e.end_time);
  EXPECT_EQ(back.scheme->cfl, e.scheme->cfl);
  EXPECT_EQ(back.material.at("a \"b\" c").density, 5e-324);
  EXPECT_EQ(back.material.at("steel").modulus, 9223372036854775808.0);
  EXPECT_TRUE(std::signbit(back.thing[0].low.x));
  EXPECT_EQ(back.thing[0].low, thing.low);
  EXPECT_EQ(back.thing[0].marks, thing.marks);
  EXPECT_EQ(back.thing[0].seed, thing.seed);
  EXPECT_EQ(back.thing.size(), 2u);
}

TEST(KeyErrors, UnknownKeyNamesTheNearest) {
  EXPECT_EQ(complaint("end_time = 1\n[scheme]\n  ordre = 5\n"),
            "s.toml:3:3: unknown key scheme.ordre; the nearest known key is scheme.order (known here: order, cfl)");
  EXPECT_EQ(complaint("[material.steel]\ndensity = 1\nmodulus_young = 2\n"),
            "s.toml:3:1: unknown key material.steel.modulus_young; the nearest known key is material.steel.modulus "
            "(known here: density, modulus)");
}

TEST(KeyErrors, KeyInTheWrongSectionIsFoundElsewhere) {
  EXPECT_EQ(complaint("cfl = 0.5"),
            "s.toml:1:1: unknown key cfl; the nearest known key is scheme.cfl (known here: end_time, cells, scheme, "
            "material, thing)");
}

TEST(KeyErrors, WrongType) {
  EXPECT_EQ(complaint("[scheme]\norder = 5.0"),
            "s.toml:2:9: scheme.order = 5.0 is a number; expected an integer, one of 1, 3, 5");
  EXPECT_EQ(complaint("scheme = true"), "s.toml:1:10: scheme = true is a boolean; expected a table");
  EXPECT_EQ(complaint("[[thing]]\nmarks = [1]"),
            "s.toml:2:10: thing[0].marks[0] = 1 is an integer; expected an array of strings");
  EXPECT_EQ(complaint("[[thing]]\nheld = 1"), "s.toml:2:8: thing[0].held = 1 is an integer; expected true or false");
  EXPECT_EQ(complaint("thing = 3"), "s.toml:1:9: thing = 3 is an integer; expected an array of tables");
  EXPECT_EQ(
      complaint("end_time = 1979-05-27"),
      "s.toml:1:12: end_time = a date or time is a date or time; expected a number in s (a bare number, or a string "
      "with a unit, such as \"1 s\"), above 0");
}

TEST(KeyErrors, WrongUnit) {
  EXPECT_EQ(
      complaint("[material.steel]\ndensity = \"7860 kg\""),
      "s.toml:2:11: material.steel.density = \"7860 kg\": 'kg' has the wrong dimension; expected a number in kg/m3 (a "
      "bare number, or a string with a unit, such as \"1 kg/m3\"), above 0");
  EXPECT_EQ(
      complaint("[scheme]\ncfl = \"0.5 m\""),
      "s.toml:2:7: scheme.cfl = \"0.5 m\": 'm' has the wrong dimension; expected a number, above 0 and at most 0.9");
}

TEST(KeyErrors, OutOfRange) {
  EXPECT_EQ(complaint("[scheme]\ncfl = 1.2"),
            "s.toml:2:7: scheme.cfl = 1.2 is out of range; expected a number, above 0 and at most 0.9");
  EXPECT_EQ(complaint("[scheme]\ncfl = nan"),
            "s.toml:2:7: scheme.cfl = nan is out of range; expected a number, above 0 and at most 0.9");
  EXPECT_EQ(complaint("[scheme]\norder = 4"),
            "s.toml:2:9: scheme.order = 4 is out of range; expected an integer, one of 1, 3, 5");
  EXPECT_EQ(complaint("cells = [10, 0]"),
            "s.toml:1:14: cells[1] = 0 is out of range; expected an array of 1 to 3 integers, at least 1");
  EXPECT_EQ(complaint("cells = [3000000000]"),
            "s.toml:1:10: cells[0] = 3000000000 is out of range; expected an integer of 32 bits");
  EXPECT_EQ(complaint("cells = []"),
            "s.toml:1:9: cells = [] has 0 elements; expected an array of 1 to 3 integers, at least 1");
  EXPECT_EQ(complaint("[[thing]]\nshape = \"bal\""),
            "s.toml:2:9: thing[0].shape = \"bal\" is not known; expected a string, one of box, ball; the nearest is "
            "\"ball\"");
}

TEST(KeyErrors, MissingKey) {
  EXPECT_EQ(
      complaint("end_time = 1\n[material.steel]\nmodulus = 1"),
      "s.toml:2:1: material.steel.density is missing; expected a number in kg/m3 (a bare number, or a string with a "
      "unit, such as \"1 kg/m3\"), above 0: density");
}

TEST(KeyErrors, BadToml) {
  EXPECT_NE(complaint("end_time = \n").find("s.toml:1:12: not valid TOML: "), std::string::npos);
  EXPECT_NE(complaint("end_time = 1\nend_time = 2\n").find("s.toml:2:1"), std::string::npos);
}

TEST(Override, ReplacesCreatesAndAppends) {
  Tree tree = parse_toml("cells = [4, 4]\n[[thing]]\nshape = \"box\"\n", "s.toml");
  apply_override(tree, "end_time=3 ms");
  apply_override(tree, "cells.1=8");
  apply_override(tree, "scheme.order=1");
  apply_override(tree, "thing.0.shape=ball");
  apply_override(tree, "thing.1.lengths=[1, '2 cm']");
  apply_override(tree, "material={ iron = { density = 7 } }");
  Everything const e = read_keys<Everything>(tree);
  EXPECT_EQ(e.end_time, 3e-3);
  EXPECT_EQ(e.cells, (std::array<Index, 3>{4, 8, 1}));
  EXPECT_EQ(e.scheme->order, 1);
  EXPECT_EQ(e.thing[0].shape, "ball");
  EXPECT_EQ(e.thing[1].lengths, (std::vector<double>{1, 0.02}));
  EXPECT_EQ(e.material.at("iron").density, 7);
}

TEST(Override, ErrorsNameTheOption) {
  EXPECT_EQ(complaint("", "scheme.order=4"),
            "--set scheme.order=4: scheme.order = 4 is out of range; expected an integer, one of 1, 3, 5");
  EXPECT_EQ(complaint("", "scheme"), "--set scheme: expected key.path=VALUE");
  EXPECT_EQ(complaint("", "scheme..order=1"), "--set scheme..order=1: the key path has an empty part");
  EXPECT_EQ(complaint("cells = [4]", "cells.7=1"), "--set cells.7=1: '7' is not an index of a list of 1 elements");
  EXPECT_EQ(complaint("end_time = 1", "end_time.x=1"),
            "--set end_time.x=1: nothing can be set below 1 (s.toml:1:12), which is not a table");
  EXPECT_EQ(complaint("", "end_time=1\nx = 2"),
            "--set end_time=1\nx = 2: end_time = \"1\\u000Ax = 2\": a unit is missing at '\nx = 2'; expected a number "
            "in s (a bare "
            "number, "
            "or a string with a unit, such as \"1 s\"), above 0");
}

TEST(Reference, PrintsKeyTypeUnitDefaultAndMeaning) {
  EXPECT_EQ(key_reference<Everything>("scheme.cfl"),
            "scheme.cfl\n    type: a number, above 0 and at most 0.9; unit: 1; default: 0.8\n    Courant number\n");
  EXPECT_EQ(key_reference<Everything>("material.steel.density"),
            "material.NAME.density\n    type: a number, above 0; unit: kg/m3; default: required\n    density\n");
  EXPECT_EQ(key_reference<Everything>("thing.0.seed"), key_reference<Everything>("thing[0].seed"));
}

TEST(Reference, HoldsEveryKey) {
  std::string const all = key_reference<Everything>();
  for (char const* key :
       {"end_time", "cells", "scheme", "scheme.order", "scheme.cfl", "material", "material.NAME.density",
        "material.NAME.modulus", "thing", "thing[].shape", "thing[].low", "thing[].held"})
    EXPECT_NE(("\n" + all).find(std::string("\n") + key + "\n"), std::string::npos) << key;
}

TEST(Reference, UnknownPathIsAnError) {
  try {
    key_reference<Everything>("scheme.clf");
    FAIL();
  } catch (Error const& error) {
    EXPECT_STREQ(error.what(), "no key scheme.clf; the nearest known key is scheme.cfl (known here: order, cfl)");
  }
}

}  // namespace
}  // namespace brisance
