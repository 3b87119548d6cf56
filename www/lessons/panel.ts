/** Lessons in the panel: a list of them, and the one that is open, step by step. */

import { announce, byId, icon, make } from "../dom";
import { onPlace } from "../memory/address";
import { openTab } from "../panels/tabs";
import { store } from "../store";
import { text } from "../text";
import { energyTerms, lessonOf, LESSONS, type Lesson } from "./lesson";
import { stage } from "./stage";

const words = text.lessons;

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
    make("h2", { id: "lessons-title" }, words.heading),
    make("p", { class: "note" }, words.note),
    make("ol", { class: "lesson-list" }, ...items),
  );
}

/** Opens a step of a lesson; whether there is one. */
async function open(id: string, wanted: number): Promise<boolean> {
  const lesson = await lessonOf(id);
  if (!lesson) {
    store.update({ message: words.unknown(id.slice(0, 40)) });
    return false;
  }
  const at = Math.min(lesson.steps.length - 1, Math.max(0, Math.trunc(wanted) || 0));
  store.update({ lessonStep: addressOf(id, at) });
  await read(lesson, at);
  openTab("learn");
  const step = lesson.steps[at]!;
  announce(words.opened(lesson.title, at + 1, lesson.steps.length));
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
  const back = make("button", { type: "button", class: "quiet" }, words.all);
  back.addEventListener("click", () => {
    store.update({ lessonStep: null });
    byId("lessons").querySelector("a")?.focus();
  });
  const next = last
    ? following(lesson.id)
    : { href: addressOf(lesson.id, at + 1), text: words.nextStep };
  byId("lessons").replaceChildren(
    make("div", { class: "panel-head" }, make("h2", { id: "lessons-title" }, lesson.title), back),
    terms,
    make("div", { class: "lesson-text" }, step.text, last ? lesson.question : null),
    make(
      "nav",
      { class: "lesson-steps", "aria-label": words.steps },
      at > 0
        ? make("a", { class: "button", href: addressOf(lesson.id, at - 1) }, words.back)
        : null,
      make("span", {}, words.step(at + 1, count)),
      next ? make("a", { class: "button primary", href: next.href }, next.text) : null,
    ),
    again(lesson, at),
  );
}

function following(id: string): { href: string; text: string } | null {
  const next = LESSONS[LESSONS.findIndex((lesson) => lesson.id === id) + 1];
  return next ? { href: addressOf(next.id, 0), text: words.nextLesson } : null;
}

/** For whoever has changed something since. */
function again(lesson: Lesson, at: number): HTMLElement {
  const button = make("button", { type: "button", class: "quiet" }, icon("reset"), words.again);
  button.addEventListener("click", () => void stage(lesson.steps[at]!));
  return button;
}
