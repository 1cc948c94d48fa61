// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Copies between all kinds of store: what goes round all of them is the same at the end, bit by bit, and flat
// text is the same text.
#include <fstream>
#include <map>

#include "eigengrasp/core/files.hpp"
#include "eigengrasp/database/store_copy.hpp"
#include "store/store_fixture.hpp"

namespace eigengrasp {
namespace {

namespace fs = std::filesystem;
using testing::RandomGrasps;
using testing::stored_hand;

class StoreCopy : public testing::StoreFixture {
 protected:
  static void fill(GraspStore& store) {
    fill_tables(store);
    store.add_source({"GraspIt!", "by hand"});
    store.add_units({{"psb_12", 1.0, "human"},
                     {"glass", 1.0, "human"},
                     {"glass", 0.75, "human"},
                     {"psb_12", 1.5, "barrett"}});
    UnitResult mixed = done({"glass", 1.0, "human"}, 4, 1);
    mixed.grasps[2].source = "GraspIt!";
    store.finish_unit(mixed);
    store.finish_unit({{"glass", 0.75, "human"}, UnitState::failed, "no grasp \"in time\"", "w", 60.0, {}});
    store.finish_unit(done({"psb_12", 1.5, "barrett"}, 3, 2));
    store.add_grasps({"psb_12", 1.0, "barrett"},
                     RandomGrasps(3).grasps({"psb_12", 1.0, "barrett"}, stored_hand("barrett", 7), 2));
    store.set_descriptors({{"glass", "surface", "voxels", {0.1, 0.2, 0.3}, 0.5, {1.0 / 3.0, 0.25}}});
    store.set_neighbors({{"glass", "psb_12", "zernike", 1.0 / 3.0}});
    store.set_alignments({{"glass", "psb_12", "pca", RandomGrasps(4).pose().matrix()}});
  }

  static void expect_same_stores(GraspStore& a, GraspStore& b) {
    EXPECT_EQ(a.models(), b.models());
    EXPECT_EQ(a.hands(), b.hands());
    EXPECT_EQ(a.sources(), b.sources());
    EXPECT_EQ(a.units(), b.units());
    EXPECT_EQ(a.descriptors(""), b.descriptors(""));
    EXPECT_EQ(a.neighbors(), b.neighbors());
    EXPECT_EQ(a.alignments(), b.alignments());
    EXPECT_EQ(a.counts(), b.counts());
    for (const StoredModel& model : a.models())
      for (const StoredHand& hand : a.hands())
        expect_same(a.grasps(model.name, hand.name), b.grasps(model.name, hand.name));
  }

  static std::map<fs::path, std::string> texts(const fs::path& folder) {
    std::map<fs::path, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) all[fs::relative(entry.path(), folder)] = read_text_file(entry.path());
    return all;
  }
};

TEST_F(StoreCopy, round_trips_between_all_stores_lose_nothing) {
  const auto first = open_store("text:" + (folder_ / "first").string());
  fill(*first);
  std::vector<std::unique_ptr<GraspStore>> stores;
  for (const char* kind : {"sqlite", "postgresql", "text", "postgresql", "sqlite"}) {
    if (!available(kind)) {
      fmt::print("{}\n", testing::PostgresServer::why_none());
      continue;
    }
    stores.push_back(open_store(new_address(kind)));
    GraspStore& from = stores.size() == 1 ? *first : *stores[stores.size() - 2];
    const CopyReport report = copy_store(from, *stores.back());
    EXPECT_EQ(report.grasps, 9);
    EXPECT_EQ(report.kept_units, 0);
    expect_same_stores(*first, *stores.back());
  }
  const auto last = open_store("text:" + (folder_ / "last").string());
  copy_store(*stores.back(), *last);
  const auto a = texts(folder_ / "first"), b = texts(folder_ / "last");
  for (const auto& [file, text] : a) {  // but for the head of a file of grasps, which numbers the files
    const std::size_t from = file.string().starts_with("grasps") ? text.find('\n') : 0;
    const std::string& other = b.at(file);
    EXPECT_EQ(text.substr(from), other.substr(from == 0 ? 0 : other.find('\n'))) << file;
  }
  EXPECT_EQ(a.size(), b.size());
}

TEST_F(StoreCopy, copying_again_adds_nothing_and_goes_on_where_it_was_cut) {
  const auto from = open_store(new_address("text"));
  fill(*from);
  const auto to = open_store(new_address("sqlite"));
  fill_tables(*to);
  to->add_source({"GraspIt!", "by hand"});
  UnitResult other = done({"psb_12", 1.5, "barrett"}, 1, 77);  // is there already, and stays
  to->finish_unit(other);
  EXPECT_EQ(copy_store(*from, *to).kept_units, 1);
  expect_same(to->grasps("psb_12", "barrett"), [&] {
    auto expected = from->grasps("psb_12", "barrett");
    expected.resize(2);  // of scale 1
    expected.push_back(other.grasps[0]);
    return expected;
  }());
  const StoreCounts counts = to->counts();
  const CopyReport again = copy_store(*from, *to);
  EXPECT_EQ(again.grasps + again.models + again.hands + again.units, 0);
  EXPECT_EQ(again.kept_units, 4);
  EXPECT_EQ(to->counts(), counts);
}

TEST_F(StoreCopy, a_claimed_unit_waits_in_the_copy) {
  const auto from = open_store(new_address("sqlite"));
  fill_tables(*from);
  from->add_units({{"glass", 1.0, "human"}});
  from->claim_unit("a", 60.0);
  const auto to = open_store(new_address("text"));
  copy_store(*from, *to);
  EXPECT_EQ(to->units().at(0).state, UnitState::waiting);
}

}  // namespace
}  // namespace eigengrasp
