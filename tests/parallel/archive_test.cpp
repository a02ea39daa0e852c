#include "parallel/archive.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "parallel/error.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::parallel {
namespace {

using testing::comm;
namespace fs = std::filesystem;

/// A folder of its own for each test program and rank count, emptied before each test.
class Archive : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = "archive_test." + std::to_string(comm().size());
    if (comm().rank() == 0) {
      fs::remove_all(folder_);
      fs::create_directories(folder_);
    }
    comm().barrier();
  }
  void TearDown() override {
    comm().barrier();
    if (comm().rank() == 0) fs::remove_all(folder_);
  }
  std::string path(std::string const& name) const { return folder_ + "/" + name; }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }

 private:
  std::string folder_;
};

double value(std::int64_t row, int column) { return std::sin(static_cast<double>(row)) * 1e3 + column; }

/// Cuts 0..total into pieces of unequal length and deals them out at random; the seed decides who gets what.
std::vector<Range> deal(std::int64_t total, Comm& ranks, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Range> mine;
  for (std::int64_t first = 0; first != total;) {
    std::int64_t const count = std::min<std::int64_t>(total - first, 1 + random() % 40);
    if (static_cast<int>(random() % static_cast<unsigned>(ranks.size())) == ranks.rank())
      mine.push_back({first, count});
    first += count;
  }
  std::shuffle(mine.begin(), mine.end(), random);
  return mine;
}

std::vector<double> values_of(std::vector<Range> const& ranges, int columns) {
  std::vector<double> data;
  for (Range const& r : ranges)
    for (std::int64_t row = r.first; row != r.first + r.count; ++row)
      for (int c = 0; c != columns; ++c) data.push_back(value(row, c));
  return data;
}

constexpr std::int64_t many = 40000;  // times 5 columns: more than a megabyte, so that several ranks write
constexpr std::array<std::int64_t, 3> cells{70, 60, 50};

/// Boxes of 32 x 32 x 50 and their remainders, dealt out like blocks.
std::vector<ArchiveWriter::Box> boxes_of(Comm& ranks) {
  std::vector<ArchiveWriter::Box> mine;
  int block = 0;
  for (std::int64_t y = 0; y < cells[1]; y += 32)
    for (std::int64_t x = 0; x < cells[0]; x += 32)
      if (block++ % ranks.size() == ranks.rank())
        mine.push_back(
            {{x, y, 0},
             {std::min<std::int64_t>(32, cells[0] - x), std::min<std::int64_t>(32, cells[1] - y), cells[2]}});
  return mine;
}

void write_all(Comm& ranks, std::string const& path, unsigned seed) {
  ArchiveWriter file(ranks, path);
  file.attribute("time", 0.1);
  file.attribute("step", std::int64_t{1} << 60);
  file.attribute("scene", std::string(200000, 'x') + "end");
  file.attribute("empty", std::string());
  auto const rows = deal(many, ranks, seed);
  file.rows("fluid/cells", many, 5, rows, values_of(rows, 5));
  auto const few = deal(3, ranks, seed);
  file.rows("few", 3, 1, few, values_of(few, 1));
  file.rows("none", 0, 3, {}, {});
  std::vector<std::int64_t> numbers;
  for (Range const& r : rows)
    for (std::int64_t row = r.first; row != r.first + r.count; ++row) numbers.push_back(-row * 1234567891011);
  file.rows_int("solid/connectivity", many, 1, rows, numbers);
  std::vector<std::int64_t> ids;
  std::vector<double> data;
  for (std::int64_t id = 900; id >= 0; id -= 7)
    if (id % ranks.size() == ranks.rank()) {
      ids.push_back(id);
      data.insert(data.end(), {value(id, 0), value(id, 1)});
    }
  file.sparse("covered", 2, ids, data);
  file.sparse("nothing", 2, {}, {});
  auto const boxes = boxes_of(ranks);
  std::vector<double> scalar, vector;
  for (auto const& box : boxes)
    for (std::int64_t z = box.first[2]; z != box.first[2] + box.size[2]; ++z)
      for (std::int64_t y = box.first[1]; y != box.first[1] + box.size[1]; ++y)
        for (std::int64_t x = box.first[0]; x != box.first[0] + box.size[0]; ++x) {
          std::int64_t const cell = x + cells[0] * (y + cells[1] * z);
          scalar.push_back(value(cell, 0));
          for (int c = 0; c != 3; ++c) vector.push_back(value(cell, c));
        }
  file.grid("density", cells, 1, boxes, scalar, true);
  file.grid("velocity", cells, 3, boxes, vector, false);
  file.close();
}

std::string content(std::string const& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void replace(std::string const& path, std::string const& bytes) {
  comm().barrier();
  if (comm().rank() == 0)
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  comm().barrier();
}

/// The message of the system error that all ranks must get; empty when none came.
template <class Work>
std::string system_error(Work const& work) {
  std::string message;
  try {
    work();
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::system);
    message = e.what();
  }
  Bytes mine;
  for (char const c : message) put(mine, c);
  for (Bytes const& other : comm().all_gather(mine)) EXPECT_EQ(other, mine) << "the ranks disagree";
  return message;
}

TEST_F(Archive, GivesBackEveryRowToAnyRank) {
  write_all(comm(), path("a.h5"), 1);
  ArchiveReader file(comm(), path("a.h5"));
  EXPECT_EQ(file.real("time"), 0.1);
  EXPECT_EQ(file.integer("step"), std::int64_t{1} << 60);
  EXPECT_EQ(file.text("scene"), std::string(200000, 'x') + "end");
  EXPECT_EQ(file.text("empty"), "");
  EXPECT_EQ(file.values(), (std::vector<std::string>{"empty", "scene", "step", "time"}));
  for (unsigned const seed : {2u, 3u}) {  // other owners than those who wrote
    auto const rows = deal(many, comm(), seed);
    EXPECT_EQ(file.rows("fluid/cells", 5, rows), values_of(rows, 5));
    auto const numbers = file.rows_int("solid/connectivity", 1, rows);
    std::size_t at = 0;
    for (Range const& r : rows)
      for (std::int64_t row = r.first; row != r.first + r.count; ++row) ASSERT_EQ(numbers[at++], -row * 1234567891011);
  }
  std::vector<Range> const overlapping{{10, 5}, {8, 4}, {39990, 10}, {8, 1}};
  EXPECT_EQ(file.rows("fluid/cells", 5, overlapping), values_of(overlapping, 5));
  EXPECT_EQ(file.rows("few", 1, std::vector<Range>{{0, 3}}), values_of({{0, 3}}, 1));
  EXPECT_TRUE(file.rows("none", 3, {}).empty());
  auto const covered = file.sparse("covered", 2);
  ASSERT_EQ(covered.ids.size(), 129u);
  for (std::size_t k = 0; k != covered.ids.size(); ++k) {
    EXPECT_EQ(covered.ids[k], static_cast<std::int64_t>(k) * 7 + 900 % 7);
    EXPECT_EQ(covered.data[2 * k + 1], value(covered.ids[k], 1));
  }
  EXPECT_TRUE(file.sparse("nothing", 2).ids.empty());
  std::int64_t const all = cells[0] * cells[1] * cells[2];
  EXPECT_EQ(file.row_count("velocity"), all);
  auto const rows = deal(all, comm(), 5);
  EXPECT_EQ(file.rows("velocity", 3, rows), values_of(rows, 3));
  auto expected = values_of(rows, 1);
  for (double& x : expected) x = static_cast<float>(x);
  EXPECT_EQ(file.rows("density", 1, rows), expected);
}

TEST_F(Archive, TheBytesDoNotShowWhoWroteThem) {
  write_all(comm(), path("a.h5"), 1);
  write_all(comm(), path("b.h5"), 77);
  if (comm().rank() == 0) {
    write_all(*serial(), path("c.h5"), 1);  // one rank, without MPI
    EXPECT_TRUE(content(path("a.h5")) == content(path("b.h5")));
    EXPECT_TRUE(content(path("a.h5")) == content(path("c.h5")));
    EXPECT_EQ(files(), 3u);  // no temporary file is left
  }
}

TEST_F(Archive, SaysWhatItHolds) {
  write_all(comm(), path("a.h5"), 1);
  ArchiveReader file(comm(), path("a.h5"));
  EXPECT_TRUE(file.has("fluid/cells"));
  EXPECT_TRUE(file.has("covered"));
  EXPECT_TRUE(file.has("time"));
  EXPECT_FALSE(file.has("fluid/other"));
  EXPECT_NE(system_error([&] { file.rows("fluid/other", 1, {}); }).find("fluid/other"), std::string::npos);
  EXPECT_NE(system_error([&] { file.rows("fluid/cells", 4, {}); }).find("5 columns"), std::string::npos);
  EXPECT_NE(system_error([&] { file.rows_int("few", 1, {}); }).find("integers"), std::string::npos);
  EXPECT_THROW(file.real("step"), Error);
  EXPECT_THROW(file.text("absent"), Error);
}

TEST_F(Archive, KeepsEveryBitOfADouble) {
  std::vector<double> const odd{-0.0, std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::infinity(),
                                std::bit_cast<double>(std::uint64_t{0x7ff8000000001234}), 1e308};
  std::vector<Range> const mine{{0, comm().rank() == 0 ? 5 : 0}};
  {
    ArchiveWriter file(comm(), path("a.h5"));
    file.rows("odd", 5, 1, mine, std::span(odd).first(comm().rank() == 0 ? 5 : 0));
    file.close();
  }
  auto const back = ArchiveReader(comm(), path("a.h5")).rows("odd", 1, std::vector<Range>{{0, 5}});
  for (std::size_t k = 0; k != odd.size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[k]), std::bit_cast<std::uint64_t>(odd[k]));
}

TEST_F(Archive, MissingFilesAndForeignFilesAreNamed) {
  EXPECT_NE(
      system_error([&] { ArchiveReader(comm(), path("no.h5")); }).find("no.h5 cannot be read: there is no such file"),
      std::string::npos);
  replace(path("text.h5"), "this is no HDF5 file\n");
  EXPECT_NE(system_error([&] { ArchiveReader(comm(), path("text.h5")); }).find("no HDF5 file"), std::string::npos);
  replace(path("empty.h5"), "");
  EXPECT_NE(system_error([&] { ArchiveReader(comm(), path("empty.h5")); }).find("empty"), std::string::npos);
  EXPECT_NE(system_error([&] { ArchiveReader(comm(), path("")); }).find("not a file"), std::string::npos);
}

TEST_F(Archive, EveryTruncationIsFound) {
  write_all(comm(), path("a.h5"), 1);
  std::string const whole = content(path("a.h5"));
  for (std::size_t const length : {std::size_t{1}, std::size_t{47}, std::size_t{100}, std::size_t{5000},
                                   whole.size() / 2, whole.size() - 4096, whole.size() - 8, whole.size() - 1}) {
    replace(path("cut.h5"), whole.substr(0, length));
    EXPECT_NE(system_error([&] { ArchiveReader(comm(), path("cut.h5")); }).find("cut.h5"), std::string::npos) << length;
  }
  // Zeros instead of the end: what a crash of a file system leaves.
  replace(path("cut.h5"), whole.substr(0, whole.size() / 3) + std::string(whole.size() - whole.size() / 3, '\0'));
  EXPECT_NE(system_error([&] { ArchiveReader(comm(), path("cut.h5")); }), "");
}

TEST_F(Archive, FlippedBitsAreFound) {
  write_all(comm(), path("a.h5"), 1);
  std::string const whole = content(path("a.h5"));
  std::mt19937 random(6);
  for (int k = 0; k != 20; ++k) {
    std::string damaged = whole;
    std::size_t const at = 200 + random() % (whole.size() - 400);
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random() % 8)));
    replace(path("bad.h5"), damaged);
    std::string const message = system_error([&] { ArchiveReader(comm(), path("bad.h5")); });
    if (!message.empty()) {
      EXPECT_NE(message.find("bad.h5"), std::string::npos);
      continue;
    }
    // Only a bit that no content rests on may go unseen: then everything still reads as it was written.
    ArchiveReader file(comm(), path("bad.h5"));
    auto const rows = deal(many, comm(), 2);
    EXPECT_EQ(file.rows("fluid/cells", 5, rows), values_of(rows, 5)) << at;
    EXPECT_LT(at, std::size_t{65536}) << "a bit among the data went unseen";
  }
}

TEST_F(Archive, ExchangedRowsAreFound) {
  write_all(comm(), path("a.h5"), 1);
  std::string bytes = content(path("a.h5"));
  double const row0 = value(0, 0), row1 = value(1, 0);
  auto const find = [&](double x) { return bytes.find(std::string(reinterpret_cast<char const*>(&x), sizeof x)); };
  std::size_t const a = find(row0), b = find(row1);
  ASSERT_NE(a, std::string::npos);
  ASSERT_NE(b, std::string::npos);
  std::swap_ranges(bytes.begin() + static_cast<std::ptrdiff_t>(a), bytes.begin() + static_cast<std::ptrdiff_t>(a) + 40,
                   bytes.begin() + static_cast<std::ptrdiff_t>(b));
  replace(path("swapped.h5"), bytes);
  EXPECT_NE(system_error([&] { ArchiveReader(comm(), path("swapped.h5")); }).find("checksum"), std::string::npos);
}

TEST_F(Archive, NothingAppearsUnderTheFinalNameBeforeClose) {
  {
    ArchiveWriter file(comm(), path("a.h5"));
    file.attribute("x", 1.0);
    comm().barrier();
    EXPECT_FALSE(fs::exists(path("a.h5")));
    comm().barrier();
  }
  comm().barrier();
  EXPECT_EQ(files(), 0u);  // and an abandoned one leaves nothing
}

TEST_F(Archive, AFailedWriteLeavesTheOldFileAlone) {
  write_all(comm(), path("a.h5"), 1);
  std::string const before = content(path("a.h5"));
  std::string const message = system_error([&] {
    ArchiveWriter file(comm(), path("a.h5"));
    std::vector<Range> const mine{{0, comm().rank() == 0 ? 1 : 0}};
    std::vector<double> const data(comm().rank() == 0 ? 1 : 0);
    file.rows("x", 1, 1, mine, data);
    throw Error(Failure::system, "something else broke");
  });
  EXPECT_EQ(message, "something else broke");
  comm().barrier();
  EXPECT_TRUE(content(path("a.h5")) == before);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Archive, AFolderThatIsNotThereIsNamed) {
  std::string const message = system_error([&] { ArchiveWriter(comm(), path("absent/a.h5")); });
  EXPECT_NE(message.find("absent/a.h5 cannot be written"), std::string::npos) << message;
  EXPECT_NE(message.find("No such file"), std::string::npos) << message;
}

/// A limit on the size of files stands for a full disk: the same calls fail, with EFBIG in place of ENOSPC.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit const now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(Archive, AFullDiskIsASystemErrorOnAllRanksAndLeavesNothing) {
  for (rlim_t const limit : {0, 1000, 70000, 1000000, 1700000, 3000000, 6000000}) {
    std::string message;
    {
      FileSizeLimit const full(limit);
      message = system_error([&] { write_all(comm(), path("a.h5"), 1); });
    }
    EXPECT_NE(message.find("a.h5 cannot be written"), std::string::npos) << limit << " " << message;
    EXPECT_NE(message.find("File too large"), std::string::npos) << limit << " " << message;
    comm().barrier();
    EXPECT_EQ(files(), 0u);
    comm().barrier();
  }
  write_all(comm(), path("a.h5"), 1);  // and the next one works
  ArchiveReader(comm(), path("a.h5"));
}

TEST_F(Archive, ALimitOfOneRankAloneStopsAll) {
  // Rank 0 gets its space; the last rank alone cannot write beyond 100 kB.
  if (comm().size() == 1) return;
  std::string message;
  {
    FileSizeLimit const full(comm().rank() == comm().size() - 1 ? 100000 : RLIM_INFINITY);
    message = system_error([&] { write_all(comm(), path("a.h5"), 1); });
  }
  EXPECT_NE(message.find("a.h5 cannot be written"), std::string::npos) << message;
  comm().barrier();
  EXPECT_EQ(files(), 0u);
}

TEST_F(Archive, RowsGivenTwiceOrNotAtAllAreInternalErrorsEverywhere) {
  for (int const first : {0, 5}) {
    try {
      ArchiveWriter file(comm(), path("a.h5"));
      std::vector<Range> mine;
      if (comm().rank() == 0) mine = {{0, 6}};
      if (comm().rank() == comm().size() - 1) mine.push_back({first == 0 ? 7 : 5, first == 0 ? 3 : 5});
      file.rows("x", 10, 1, mine, values_of(mine, 1));
      FAIL();
    } catch (Error const& e) {
      EXPECT_EQ(e.kind(), Failure::internal);
      EXPECT_NE(std::string(e.what()).find(first == 0 ? "row 6 of x is given by no rank" : "row 5 of x is given twice"),
                std::string::npos)
          << e.what();
    }
    comm().barrier();
  }
}

TEST_F(Archive, TextFilesAppearWhole) {
  std::string const text(100000, 'a');
  write_text_atomically(comm(), path("summary.json"), text);
  EXPECT_TRUE(content(path("summary.json")) == text);
  comm().barrier();
  {
    FileSizeLimit const full(5000);
    EXPECT_NE(
        system_error([&] { write_text_atomically(comm(), path("summary.json"), text + "b"); }).find("File too large"),
        std::string::npos);
  }
  EXPECT_TRUE(content(path("summary.json")) == text);
  comm().barrier();
  EXPECT_EQ(files(), 1u);
  comm().barrier();  // nobody writes while another counts
  write_text_atomically(comm(), path("summary.json"), "");
  EXPECT_EQ(content(path("summary.json")), "");
}

}  // namespace
}  // namespace brisance::parallel
