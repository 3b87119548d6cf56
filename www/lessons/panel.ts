/** Lessons in the panel: a list of them, and the one that is open, step by step. */

import { announce, byId, icon, make } from "../dom";
import { onPlace } from "../memory/address";
import { openTab } from "../panels/tabs";
import { store } from "../store";
import { energyTerms, lessonOf, LESSONS, type Lesson } from "./lesson";
import { stage } from "./stage";

/** What addresses of lessons begin with: `#learn/aperture/2`. */
const PLACE = "learn";

const addressOf = (id: string, step: number) => `#${PLACE}/${id}/${step + 1}`;

export function mountLessons(): void {
  list();
  onPlace(PLACE, ([id = "", step = "1"]) => open(id, Number(step) - 1));
  // A lesson that is open has the page's address.
  store.watch(
    ({ lessonStep }) => [lessonStep],
    ({ lessonStep }) => {
      if (!lessonStep) list();
    },
  );
}

/** All lessons. */
function list(): void {
  const items = LESSONS.map(({ id, title }) => {
    const link = make("a", { href: addressOf(id, 0) }, title);
    return make("li", {}, link);
  });
  byId("lessons").replaceChildren(
    make("h2", { id: "lessons-title" }, "Lessons"),
    make(
      "p",
      { class: "note" },
      "Each opens on the solver itself, which you can change as you like.",
    ),
    make("ol", { class: "lesson-list" }, ...items),
  );
}

/** Opens a step of a lesson; whether there is one. */
async function open(id: string, wanted: number): Promise<boolean> {
  const lesson = await lessonOf(id);
  if (!lesson) {
    store.update({
      message: `There is no lesson called “${id.slice(0, 40)}”. The list is under Learn.`,
    });
    return false;
  }
  const at = Math.min(lesson.steps.length - 1, Math.max(0, Math.trunc(wanted) || 0));
  store.update({ lessonStep: addressOf(id, at) });
  await read(lesson, at);
  openTab("learn");
  const step = lesson.steps[at]!;
  announce(`${lesson.title}, step ${at + 1} of ${lesson.steps.length}.`);
  await stage(step);
  return true;
}

/** Shows the text of a step. */
async function read(lesson: Lesson, at: number): Promise<void> {
  const step = lesson.steps[at]!;
  const count = lesson.steps.length;
  const last = at === count - 1;
  const terms = make("div", { class: "terms", "data-term": step.term });
  if (step.term) terms.append(await energyTerms());
  const back = make("button", { type: "button", class: "quiet" }, "All lessons");
  back.addEventListener("click", () => {
    store.update({ lessonStep: null });
    byId("lessons").querySelector("a")?.focus();
  });
  const next = last
    ? following(lesson.id)
    : { href: addressOf(lesson.id, at + 1), text: "Next step" };
  byId("lessons").replaceChildren(
    make("div", { class: "panel-head" }, make("h2", { id: "lessons-title" }, lesson.title), back),
    terms,
    make("div", { class: "lesson-text" }, step.text, last ? lesson.question : null),
    make(
      "nav",
      { class: "lesson-steps", "aria-label": "Steps of the lesson" },
      at > 0 ? make("a", { class: "button", href: addressOf(lesson.id, at - 1) }, "Back") : null,
      make("span", {}, `Step ${at + 1} of ${count}`),
      next ? make("a", { class: "button primary", href: next.href }, next.text) : null,
    ),
    again(lesson, at),
  );
}

function following(id: string): { href: string; text: string } | null {
  const next = LESSONS[LESSONS.findIndex((lesson) => lesson.id === id) + 1];
  return next ? { href: addressOf(next.id, 0), text: "Next lesson" } : null;
}

/** For whoever has changed something since. */
function again(lesson: Lesson, at: number): HTMLElement {
  const button = make(
    "button",
    { type: "button", class: "quiet" },
    icon("reset"),
    "Set this step up again",
  );
  button.addEventListener("click", () => void stage(lesson.steps[at]!));
  return button;
}
