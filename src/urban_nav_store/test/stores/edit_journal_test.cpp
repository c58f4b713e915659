// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/edit_journal.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/folder.hpp"
#include "urban_nav_store/merge.hpp"

namespace urban_nav_store {
namespace {

using testing::Folder;

constexpr const char *kOne = "0123456789abcdef", *kOther = "fedcba9876543210";

Edge closure(const SessionId& a, std::int64_t stamp_a, const SessionId& b, std::int64_t stamp_b) {
  Edge edge;
  edge.a = {a, stamp_a};
  edge.b = {b, stamp_b};
  edge.kind = EdgeKind::Stereo;
  edge.source = "loop_metric";
  return edge;
}

StoredEdit rejection(const Edge& edge) {
  StoredEdit edit;
  edit.session = edge.b.session;
  edit.action = "reject";
  edit.edge = edge;
  return edit;
}

class Journal : public ::testing::Test {
 protected:
  void fill(const std::string& name, const SessionId& id) const {
    Store store(folder.file(name), Access::Write);
    store.sessions().put({id, name, "", "", 0, true});
    for (int i = 1; i < 4; ++i) store.graph().put(closure(id, i, id, 10 * i));
    store.commit();
  }
  static std::vector<std::int64_t> standing(Store& store) {
    std::vector<std::int64_t> numbers;
    for (const StoredEdit& edit : EditJournal(store).standing()) numbers.push_back(edit.number);
    return numbers;
  }
  const Folder folder;
};

using Numbers = std::vector<std::int64_t>;

TEST_F(Journal, UndoesAndRedoesInOrder) {
  fill("s.db", kOne);
  Store store(folder.file("s.db"), Access::Write);
  EditJournal journal(store);
  for (int i = 1; i < 4; ++i) EXPECT_EQ(journal.append(rejection(closure(kOne, i, kOne, 10 * i))), i);
  EXPECT_EQ(journal.undo(2), (Numbers{3, 2}));
  EXPECT_EQ(standing(store), Numbers{1});
  EXPECT_EQ(journal.redo(), 2);
  EXPECT_EQ(standing(store), (Numbers{1, 2}));
  EXPECT_EQ(journal.append(rejection(closure(kOne, 3, kOne, 30))), 4) << "numbers are not reused";
  EXPECT_EQ(journal.redo(), std::nullopt) << "another edit followed";
  EXPECT_EQ(journal.undo(100), (Numbers{4, 2, 1}));
  EXPECT_EQ(journal.redo(), 1);
  EXPECT_EQ(journal.redo(), 2);
  EXPECT_EQ(journal.redo(), 4);
  EXPECT_EQ(journal.redo(), std::nullopt);
  EXPECT_EQ(journal.all().size(), 4u);
}

TEST_F(Journal, EditsComeBackAsTheyWere) {
  fill("s.db", kOne);
  StoredEdit edit = rejection(closure(kOne, 1, kOne, 10));
  edit.action = "pin";
  edit.arguments = "+3 --at 1,2,3";
  edit.edge.measured.T_a_b = urban_nav_core::Pose(Eigen::Quaterniond(0.8, 0.6, 0.0, 0.0), {1.0, 2.0, 3.0});
  edit.edge.measured.information.diagonal().setConstant(7.0);
  edit.p_base = {1.0, 2.0, 3.0};
  edit.p_map = {4.0, 5.0, 6.0};
  edit.sigma = 0.02;
  edit.evidence = std::string("bytes\0of it", 11);
  {
    Store store(folder.file("s.db"), Access::Write);
    EditJournal(store).append(edit);
    store.commit();
  }
  Store store(folder.file("s.db"), Access::Read);
  const std::vector<StoredEdit> all = EditJournal(store).all();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].arguments, edit.arguments);
  EXPECT_EQ(all[0].evidence, edit.evidence);
  EXPECT_EQ(all[0].p_base, edit.p_base);
  EXPECT_EQ(all[0].p_map, edit.p_map);
  EXPECT_EQ(all[0].sigma, edit.sigma);
  EXPECT_EQ(edgeKey(all[0].edge), edgeKey(edit.edge));
  EXPECT_EQ(all[0].edge.measured.T_a_b.t(), edit.edge.measured.T_a_b.t());
  EXPECT_EQ(all[0].edge.measured.information, edit.edge.measured.information);
  EXPECT_FALSE(all[0].undone);
}

TEST_F(Journal, NumbersOfEdgesStayWhenOthersAreAdded) {
  fill("s.db", kOne);
  Store store(folder.file("s.db"), Access::Write);
  const std::map<EdgeKey, std::int64_t> listed = readEdgeNumbers(store);
  EXPECT_EQ(listed.at(edgeKey(closure(kOne, 2, kOne, 20))), 2);
  storeEdgeNumbers(store);
  store.graph().put(closure(kOne, 1, kOne, 5));  // before all others
  const std::map<EdgeKey, std::int64_t> numbers = readEdgeNumbers(store);
  EXPECT_EQ(numbers.at(edgeKey(closure(kOne, 2, kOne, 20))), 2);
  EXPECT_EQ(numbers.at(edgeKey(closure(kOne, 1, kOne, 5))), 4);
}

TEST_F(Journal, AMergeOfOneStoreKeepsEveryNumber) {
  fill("s.db", kOne);
  {
    Store store(folder.file("s.db"), Access::Write);
    storeEdgeNumbers(store);
    EditJournal journal(store);
    for (int i = 1; i < 4; ++i) journal.append(rejection(closure(kOne, i, kOne, 10 * i)));
    journal.undo(1);
    store.commit();
  }
  merge({folder.file("s.db")}, folder.file("out.db"));
  Store before(folder.file("s.db"), Access::Read), after(folder.file("out.db"), Access::Read);
  EXPECT_EQ(readEdgeNumbers(before), readEdgeNumbers(after));
  EXPECT_EQ(standing(before), standing(after));
  EXPECT_EQ(EditJournal(after).all().size(), 3u);
}

TEST_F(Journal, AMergeRenumbersConflictsInAnyOrder) {
  for (const auto& [name, id] : {std::make_pair("a.db", kOne), std::make_pair("b.db", kOther)}) {
    fill(name, id);
    Store store(folder.file(name), Access::Write);
    storeEdgeNumbers(store);
    EditJournal(store).append(rejection(closure(id, 2, id, 20)));
    store.commit();
  }
  merge({folder.file("a.db"), folder.file("b.db")}, folder.file("ab.db"));
  merge({folder.file("b.db"), folder.file("a.db")}, folder.file("ba.db"));
  Store ab(folder.file("ab.db"), Access::Read), ba(folder.file("ba.db"), Access::Read);
  EXPECT_EQ(standing(ab), (Numbers{1, 2}));
  const std::map<EdgeKey, std::int64_t> numbers = readEdgeNumbers(ab);
  EXPECT_EQ(numbers, readEdgeNumbers(ba));
  std::set<std::int64_t> different;
  for (const auto& [key, number] : numbers) different.insert(number);
  EXPECT_EQ(different.size(), 6u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(edgeKey(EditJournal(ab).all()[i].edge), edgeKey(EditJournal(ba).all()[i].edge));
}

TEST_F(Journal, GoesWithItsSession) {
  fill("s.db", kOne);
  Store store(folder.file("s.db"), Access::Write);
  EditJournal(store).append(rejection(closure(kOne, 1, kOne, 10)));
  store.sessions().clear(kOne);  // before it is mapped again
  store.sessions().put({kOne, "", "", "", 0, true});
  EXPECT_EQ(EditJournal(store).all().size(), 1u) << "edits are not results";
  store.sessions().remove(kOne);
  store.sessions().put({kOne, "", "", "", 0, true});
  EXPECT_TRUE(EditJournal(store).all().empty());
}

}  // namespace
}  // namespace urban_nav_store
