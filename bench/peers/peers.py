"""What others reach on relievo's sequences, and how relievo compares: see README.md beside this."""

import argparse
import csv
from pathlib import Path

import numpy as np

import flows
import layers
import sequences

COLUMNS = ["name", "dis_aee", "tvl1_aee", "affine_labels_wrong"]

# Sequence, then preset, then figure: as `npm run accuracy -- --tsv` writes them.
Ours = dict[str, dict[str, dict[str, float | None]]]


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("folder", type=Path, help="what `npm run accuracy -- --export` wrote")
    options.add_argument("--ours", type=Path, help="what `npm run accuracy -- --tsv` wrote")
    options.add_argument("--out", type=Path, help="where to write the peers' figures, tab-separated")
    asked = options.parse_args()
    ours = read_ours(asked.ours) if asked.ours else {}
    presets = sorted({preset for row in ours.values() for preset in row})
    print_head(presets)
    figures = []
    ratios: dict[str, list[tuple[float, str]]] = {preset: [] for preset in presets}
    for sequence in sequences.read_all(asked.folder):
        peers = measure(sequence)
        figures.append(peers)
        found = ours.get(sequence.name, {})
        print_row(peers, [found.get(preset) for preset in presets])
        if sequence.moving() > 1:
            for preset in found:
                ratios[preset].append((over_better(found[preset], peers), sequence.name))
    for preset in presets:
        summarise(preset, ratios[preset])
    if asked.out:
        with asked.out.open("w", encoding="utf8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, delimiter="\t", lineterminator="\n")
            writer.writeheader()
            writer.writerows(figures)


def measure(sequence: sequences.Sequence) -> dict:
    dis = flows.dis(*sequence.grey)
    tvl1 = flows.tvl1(*sequence.grey)
    wrong = None
    if sequence.circles:
        labels = layers.cluster(tvl1, sequence.circles)
        wrong = float((labels != sequence.labels).mean())
    return {
        "name": sequence.name,
        "dis_aee": flows.aee(dis, sequence.flow, sequence.known),
        "tvl1_aee": flows.aee(tvl1, sequence.flow, sequence.known),
        "affine_labels_wrong": wrong,
    }


def read_ours(path: Path) -> Ours:
    number = lambda text: float(text) if text else None
    found: Ours = {}
    with path.open(encoding="utf8", newline="") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            figures = {key: number(row[key]) for key in ("aee", "labels_wrong")}
            found.setdefault(row["name"], {})[row["preset"]] = figures
    return found


def over_better(ours: dict, peers: dict) -> float:
    """Our AEE over that of the better of the two flows."""
    return ours["aee"] / min(peers["dis_aee"], peers["tvl1_aee"])


def print_head(presets: list[str]) -> None:
    head = ["sequence", "DIS, px", "TV-L1, px", "affine layers: labels wrong, %"]
    for preset in presets:
        head += [f"`{preset}`, px", "over the better flow", "labels wrong, %"]
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head), flush=True)


def print_row(peers: dict, ours: list[dict | None]) -> None:
    cells = [f"`{peers['name']}`", f"{peers['dis_aee']:.3f}", f"{peers['tvl1_aee']:.3f}"]
    cells.append(percent(peers["affine_labels_wrong"]))
    for found in ours:
        if found is None:
            cells += ["–"] * 3
        else:
            ratio = over_better(found, peers)
            cells += [f"{found['aee']:.3f}", f"{ratio:.2f}", percent(found["labels_wrong"])]
    print("| " + " | ".join(cells) + " |", flush=True)


def summarise(preset: str, ratios: list[tuple[float, str]]) -> None:
    if not ratios:
        return
    mean = np.exp(np.mean([np.log(ratio) for ratio, _ in ratios]))
    largest, where = max(ratios)
    print(
        f"\n`{preset}`: AEE over that of the better flow, on the {len(ratios)} sequences with more than one moving"
        f" region: {mean:.3f} in the geometric mean, {largest:.2f} at most (`{where}`)."
    )


def percent(share: float | None) -> str:
    return "–" if share is None else f"{100 * share:.1f}"


if __name__ == "__main__":
    main()
