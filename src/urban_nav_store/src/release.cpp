// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/release.hpp"

#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "file/header.hpp"
#include "schema/schema.hpp"
#include "store_implementation.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/digest.hpp"
#include "urban_nav_store/dump.hpp"

namespace urban_nav_store {

namespace {

constexpr const char* kVersion = "release/version";
constexpr const char* kDigest = "release/digest";
constexpr const char* kParents = "release/parents";

}  // namespace

bool isRelease(const std::string& path) { return fileKind(path) == FileKind::Release; }

ReleaseHead readReleaseHead(Store& release) {
  ReleaseHead head;
  for (const Session& session : release.sessions().all())
    for (const Property& property : release.sessions().properties(session.id)) {
      if (property.name == kVersion) head.version = urban_nav_core::parseInteger(property.value).value_or(0);
      if (property.name == kDigest) head.digest = property.value;
      if (property.name != kParents) continue;
      for (std::size_t begin = 0; begin < property.value.size();) {
        const std::size_t end = std::min(property.value.find(' ', begin), property.value.size());
        head.parents.push_back(property.value.substr(begin, end - begin));
        begin = end + 1;
      }
    }
  if (head.digest.empty() || head.version < 1)
    throw urban_nav_core::DataError(release.path(), "is damaged: its release identity is missing",
                                    "a file written by urban_nav release");
  return head;
}

ReleaseHead freeze(const std::string& store, const SessionId& first, ReleaseHead head, const std::string& path) {
  std::string parents;
  for (const std::string& parent : head.parents) parents += (parents.empty() ? "" : " ") + parent;
  {
    Store opened(store, Access::Write);
    opened.sessions().put(first, Property{kVersion, std::to_string(head.version)});
    opened.sessions().put(first, Property{kParents, parents});
    opened.commit();
    head.digest = sha256(dump(opened));
    opened.sessions().put(first, Property{kDigest, head.digest});
    opened.commit();
    Connection& connection = opened.implementation().connection;
    Statement checkpoint = connection.prepare("PRAGMA wal_checkpoint(TRUNCATE)");
    while (checkpoint.step()) continue;
    opened.close();
  }
  urban_nav_core::PartialFile partial(resolved(path), ".freezing");
  ::unlink(partial.path().c_str());  // left by a killed process
  {
    Connection connection(store, Connection::Mode::Write);
    Statement copy = connection.prepare("VACUUM INTO ?");
    copy.bind(0, std::string_view(partial.path()));
    while (copy.step()) continue;
  }
  {
    Connection connection(partial.path(), Connection::Mode::Write, path);
    Statement journal = connection.prepare("PRAGMA journal_mode=DELETE");
    while (journal.step()) continue;
    journal.reset();
    connection.execute("PRAGMA application_id=" + std::to_string(schema::kReleaseId));
    connection.close();
  }
  partial.commit();
  return head;
}

}  // namespace urban_nav_store
