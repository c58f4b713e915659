#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains each classifier on the training part of two labelled data sets and evaluates it on their validation part.

    streets.py DATA URBAN_NAV    DATA: folder with kitti_0005 and oakland; URBAN_NAV: the command

Prints the tables of README.md.
"""
import json
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

KITTI = {0: "ignore", 1: "grass", 2: "paved", 3: "dirt_path", 4: "wall", 5: "wall", 6: "foliage", 7: "vehicle",
         8: "other"}
OAKLAND = {
    **{k: "other" for k in (*range(1100, 1120), 1201, 1410, 1500, 1502, 1503, 1600, 1601)},
    **{k: "paved" for k in (1200, 1203, 1205, 1206)}, 1301: "grass", 1204: "dirt_path",
    **{k: "wall" for k in (1400, 1401, 1411, 1412)}, **{k: "foliage" for k in (1300, *range(1302, 1307))},
    1501: "vehicle", **{k: "ignore" for k in (*range(1000, 1006), 1202, 9999)}}


RELLIS = {0: "ignore", 1: "dirt_path", 3: "grass", 4: "foliage", 7: "ignore", 8: "vehicle", 10: "paved", 12: "wall", 19: "foliage", 23: "paved",
          33: "dirt_path", **{k: "other" for k in (5, 6, 9, 15, 17, 18, 27, 31, 34)}}


def copy_scenes(source, target, has_images=True):
    target.mkdir(parents=True)
    for path in source:
        name = path.name.replace("_points.csv.gz", "").replace(".csv.gz", "")
        shutil.copy(path, target / f"{name}_points.csv.gz")
        image = next((one for one in (path.parent / f"{name}.jpg", path.parent / "image.jpg") if one.exists()), None)
        if has_images and image:
            shutil.copy(image, target / f"{name}.jpg")
            folder = path.parent if (path.parent / "projection.txt").exists() else path.parent.parent
            shutil.copy(folder / "projection.txt", target)


def run(*words):
    """Runs a command; returns its processor time, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def evaluate_default(command, folder, table):
    """Returns the cells of the default model, which is not trained on these data sets, on a folder of scenes."""
    result_file = folder / "default.json"
    run(command, "labels", "evaluate", "default", folder, "--classes", table, "--json", result_file)
    said = json.loads(result_file.read_text())
    sure_rows, points = said["sure_confusion"]["rows"], said["points"]
    sure = sum(map(sum, sure_rows))
    right = sum(row[k] for k, row in enumerate(sure_rows))
    found = ", ".join(f"{name} {100 * one['recall']:.0f}" for name, one in said["classes"].items() if one["points"] >= 100)
    return (f"{points} | {100 * said['accuracy']:.0f} | {100 * sure / points:.0f} | {100 * right / max(1, sure):.1f} | "
            f"{100 * (sure - right) / points:.1f} | {found} | {said['calibration_error']:.3f}")


def try_default(data, command, work):
    """Evaluates the default model on all clouds, with their images and without."""
    sets = [(f"kitti_0005 {part}", sorted((data / "kitti_0005" / part).glob("*_points.csv.gz")), KITTI) for part in ("train", "validation")]
    sets += [(f"oakland {path.name[:-7]}", [path], OAKLAND) for path in sorted((data / "oakland").glob("*.csv.gz"))]
    sets.append(("rellis_frame", [data / "rellis_frame/points.csv.gz"], RELLIS))
    print("\n| cloud | points | right, % | sure, % | of these right, % | wrong and sure, % | found by class, % | calibration error |\n|---|---|---|---|---|---|---|---|")
    for name, source, classes in sets:
        table = work / "classes_of_default.csv"
        table.write_text("id,class\n" + "".join(f"{k},{v}\n" for k, v in sorted(classes.items())))
        for has_images in (False, True):
            folder = work / f"default_{name}_{has_images}".replace(" ", "_")
            copy_scenes(source, folder, has_images)
            if has_images and not list(folder.glob("*.jpg")):
                continue
            print(f"| {name}{', image' if has_images else ''} | {evaluate_default(command, folder, table)} |", flush=True)


def main():
    data, command = pathlib.Path(sys.argv[1]), sys.argv[2]
    sets = {"kitti_0005": (sorted((data / "kitti_0005/train").glob("*_points.csv.gz")),
                           sorted((data / "kitti_0005/validation").glob("*_points.csv.gz")), KITTI,
                           ("paved", "wall", "vehicle", "other")),
            "oakland": (sorted((data / "oakland").glob("train_*")), sorted((data / "oakland").glob("validation_*")),
                        OAKLAND, ("paved", "wall", "foliage", "vehicle"))}
    print("| set | classifier | features | accuracy | mean F1 | F1 by class | calibration error | unsure | "
          "training, CPU s | CPU us/point |\n|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        for name, (train, validation, classes, _) in sets.items():
            copy_scenes(train, work / name / "train")
            copy_scenes(validation, work / name / "validation")
            (work / name / "classes.csv").write_text(
                "id,class\n" + "".join(f"{k},{v}\n" for k, v in sorted(classes.items())))
        for kind, features in (("boosted", "all"), ("boosted", "paper"), ("forest", "all"), ("svm", "all")):
            for name, (_, _, _, scored) in sets.items():
                model, result_file, table = work / "model", work / "told.json", work / name / "classes.csv"
                seconds = run(command, "labels", "train", work / name / "train", "-o", model, "--classes", table, "--classifier",
                              kind, "--features", features, "--json", result_file)
                labelling = run(command, "labels", "evaluate", model, work / name / "validation", "--classes", table, "--json", result_file,
                                "--threads", 1)
                said = json.loads(result_file.read_text())
                f1 = {c: said["classes"][c]["f1"] for c in scored}
                print(f"| {name} | {kind} | {features} | {said['accuracy']:.3f} | {sum(f1.values()) / len(f1):.3f} | "
                      + ", ".join(f"{c} {100 * v:.0f}" for c, v in f1.items())
                      + f" | {said['calibration_error']:.3f} | {100 * said['unsure_share']:.0f} % | {seconds:.0f} | "
                      f"{1e6 * labelling / said['points']:.0f} |", flush=True)
        try_default(data, command, work)


if __name__ == "__main__":
    main()
