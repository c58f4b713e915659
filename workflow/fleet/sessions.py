# SPDX-License-Identifier: BSD-3-Clause
"""What became of each recording: joined to others, a map of its own, or failed."""
import json
from pathlib import Path


def read(path):
    return json.loads(Path(path).read_text())


def name_of(summary):
    return Path(summary).parent.name


def split_summaries(summaries):
    """Returns the stores of recordings that were mapped, {NAME: path}, and the reasons of the others, {NAME: text}."""
    stores, failed = {}, {}
    for summary in summaries:
        reason = read(summary).get("failed")
        if reason is None:
            stores[name_of(summary)] = str(Path(summary).with_name("session.db"))
        else:
            failed[name_of(summary)] = reason
    return stores, failed


def sessions_by_recording(plan):
    """Returns the ids of the sessions of each recording of a plan of `join`, {NAME: ids}."""
    content = read(plan)
    names = [Path(store["path"]).parent.name for store in content["stores"]]
    ids = {name: [] for name in names}
    for session in content["sessions"]:
        ids[names[session["store"]]].append(session["id"])
    return ids


def findings_of(doctor):
    """Returns the findings of a report of `doctor`, each as text."""
    return [finding["text"] for finding in read(doctor)["findings"]] if doctor else []


def list_states(summaries, plan, joined, doctors):
    """Returns one row for each recording, in the order of `summaries`. A recording is joined if a session of it shares
    a map with a session of another recording. `doctors`: {NAME: the report of doctor}."""
    _, failed = split_summaries(summaries)
    ids = sessions_by_recording(plan)
    recording_of = {session: name for name, its in ids.items() for session in its}
    finished = read(joined)
    partners = {name: set() for name in ids}
    for group in finished["maps"]:
        of_group = {recording_of[session] for session in group if session in recording_of}
        for name in of_group:
            partners[name] |= of_group - {name}
    reasons = {row["session"]: row["reason"] for row in finished["apart"]}
    rows = []
    for summary in summaries:
        name = name_of(summary)
        if name in failed:
            state, reason = "failed", failed[name]
        elif partners.get(name):
            state, reason = "joined", ""
        else:
            its = [reasons[session] for session in ids.get(name, []) if session in reasons]
            state, reason = "apart", "; ".join(dict.fromkeys(its)) or "no other recording was mapped"
        rows.append({"name": name, "state": state, "reason": reason, "findings": findings_of(doctors.get(name))})
    return rows
