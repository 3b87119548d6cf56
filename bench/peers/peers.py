"""What others reach on relievo's sequences: python peers.py FOLDER [--ours TSV] [--out TSV]."""

import argparse
import csv
from pathlib import Path

import numpy as np

import flows
import layers
import sequences

COLUMNS = ["name", "dis_aee", "tvl1_aee", "affine_labels_wrong"]


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("folder", type=Path, help="what `npm run accuracy -- --export` wrote")
    options.add_argument("--ours", type=Path, help="what `npm run accuracy -- --tsv` wrote")
    options.add_argument("--out", type=Path, help="where to write the figures, tab-separated")
    asked = options.parse_args()
    ours = read_ours(asked.ours) if asked.ours else {}
    presets = sorted({preset for row in ours.values() for preset in row})
    head = ["sequence", "DIS, px", "TV-L1, px", "affine layers of TV-L1: labels wrong, %"]
    for preset in presets:
        head += [f"{preset}, px", f"{preset} / better", f"{preset}: labels wrong, %"]
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head), flush=True)
    figures = []
    ratios: dict[str, list[tuple[float, str, bool]]] = {preset: [] for preset in presets}
    for sequence in sequences.read_all(asked.folder):
        row = measure(sequence)
        figures.append(row)
        cells = [f"`{row['name']}`", f"{row['dis_aee']:.3f}", f"{row['tvl1_aee']:.3f}"]
        cells.append(share(row["affine_labels_wrong"]))
        better = min(row["dis_aee"], row["tvl1_aee"])
        for preset in presets:
            found = ours.get(sequence.name, {}).get(preset)
            if found is None:
                cells += ["–"] * 3
                continue
            ratio = found["aee"] / better
            ratios[preset].append((ratio, sequence.name, sequence.moving() > 1))
            cells += [f"{found['aee']:.3f}", f"{ratio:.2f}", share(found["labels_wrong"])]
        print("| " + " | ".join(cells) + " |", flush=True)
    for preset, all_ratios in ratios.items():
        summarise(preset, [(ratio, name) for ratio, name, several in all_ratios if several])
    if asked.out:
        with asked.out.open("w", encoding="utf8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, delimiter="\t", lineterminator="\n")
            writer.writeheader()
            writer.writerows(figures)


def measure(sequence: sequences.Sequence) -> dict[str, object]:
    dis = flows.dis(*sequence.grey)
    tvl1 = flows.tvl1(*sequence.grey)
    labels = layers.cluster(tvl1, sequence.circles)
    wrong = float((labels != sequence.labels).mean()) if sequence.circles else None
    return {
        "name": sequence.name,
        "dis_aee": flows.aee(dis, sequence.flow, sequence.known),
        "tvl1_aee": flows.aee(tvl1, sequence.flow, sequence.known),
        "affine_labels_wrong": wrong,
    }


def read_ours(path: Path) -> dict[str, dict[str, dict[str, float]]]:
    """Sequence, then preset: AEE in pixels and the share of labels that are wrong."""
    found: dict[str, dict[str, dict[str, float]]] = {}
    with path.open(encoding="utf8", newline="") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            figures = {key: float(row[key]) for key in ("aee", "labels_wrong")}
            found.setdefault(row["name"], {})[row["preset"]] = figures
    return found


def summarise(preset: str, ratios: list[tuple[float, str]]) -> None:
    if not ratios:
        return
    mean = np.exp(np.mean([np.log(ratio) for ratio, _ in ratios]))
    largest, where = max(ratios)
    print(
        f"\n{preset}: AEE over the better of DIS and TV-L1, on the {len(ratios)} sequences with more than one"
        f" moving region: {mean:.3f} in the geometric mean, {largest:.2f} at most (`{where}`)."
    )


def share(value: float | None) -> str:
    return "–" if value is None else f"{100 * value:.1f}"


if __name__ == "__main__":
    main()
