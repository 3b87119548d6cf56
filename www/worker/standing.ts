/** Going on from where a solver stood. */

import { carriedOn } from "./carried";
import type { Solver } from "./core";
import { unsqueeze } from "./keeping";
import { build, type Owned } from "./owned";
import type { Begun, Contour, Setup, Standing } from "./protocol";

/**
 * A solver that goes on under `setup` from where another stood: with all that it had found, or, where the settings do not
 * allow that, from its curves alone. It comes with the curves that it goes back to.
 */
export async function goOnFrom(
  owned: Owned,
  { setup: before, bytes }: Standing,
  setup: Setup,
): Promise<Begun & { solver: Solver }> {
  if (bytes.length === 0) {
    return { solver: build(owned, setup), whole: true, shapes: setup.shapes };
  }
  const plain = await unsqueeze(bytes);
  const whole = keepsAll(before, setup);
  let solver = build(owned, whole ? { ...before, shapes: setup.shapes } : before);
  try {
    solver.setState(plain);
    if (whole) {
      // A setting, even if it is the same, makes a solver that has stopped go on.
      const same = JSON.stringify(setup.options) === JSON.stringify(before.options);
      if (!same || solver.status !== "running") solver.setOptions(JSON.stringify(setup.options));
      return { solver, whole, shapes: setup.shapes };
    }
    const contours = JSON.parse(solver.contours()) as Contour[];
    const shapes = carriedOn(before.shapes, contours);
    const afresh = build(owned, { ...setup, shapes });
    solver.free();
    solver = afresh;
    return { solver, whole, shapes };
  } catch (error) {
    solver.free();
    throw error;
  }
}

/** Whether what was found under one setup can be gone on from under another. */
function keepsAll(before: Setup, after: Setup): boolean {
  const same = (one: unknown, other: unknown) => JSON.stringify(one) === JSON.stringify(other);
  const options = (["preset", "detail", "lighting"] as const).every((key) =>
    same(before.options[key], after.options[key]),
  );
  const curves = before.shapes.length === after.shapes.length;
  return options && curves && same(before.camera, after.camera);
}
