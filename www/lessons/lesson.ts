/**
 * A lesson as data: an HTML file of steps, each with text and the state of the page that it speaks of, in a folder for each
 * language. Their titles are in `www/text`.
 *
 *     <article data-title="…">
 *       <section data-state="#blocks/motion?o=preset:paper" data-solve="run" data-term="data"> … </section>
 *       <details> … </details>
 *     </article>
 *
 * `data-state` is a link as the page itself makes them (`memory/link.ts`). `data-solve` says what is done with it: `run`,
 * a number of passes, or nothing. `data-beside` is an option with which it is solved once more, to stand beside that. `data-term` names the term of (7) that the step is about.
 */

import { text } from "../text";

/** A step of a lesson. */
export interface Step {
  text: Node;
  state: string;
  /** "run", a number of passes, or "". */
  solve: string;
  /** `key:value` of an option, or "". */
  beside: string;
  /** "data", "smoothness", "length" or "". */
  term: string;
}

/** A lesson. */
export interface Lesson {
  id: string;
  title: string;
  steps: Step[];
  /** A question, and its answer to unfold, after the last step. */
  question: Node | null;
}

/** In the order in which they are taught. */
const ORDER = [
  ...["aperture", "rigid", "scale", "weights", "diffusion", "start"],
  ...["still", "small", "occlusion", "scales", "flow", "anaglyph"],
] as (keyof typeof text.lessons.titles)[];

export const LESSONS = ORDER.map((id) => ({ id, title: text.lessons.titles[id] }));

const files = import.meta.glob<string>(["./*.html", "./*/*.html"], {
  query: "?raw",
  import: "default",
});

/** Loads a lesson; `null` when there is none of that name. */
export async function lessonOf(id: string): Promise<Lesson | null> {
  const known = LESSONS.find((lesson) => lesson.id === id);
  const load = files[`./${text.language}/${id}.html`];
  return known && load ? parsed(known, await load()) : null;
}

/** (7), each of its terms marked. */
export async function energyTerms(): Promise<Node> {
  return fragment(await files["./energy.html"]!());
}

function parsed({ id, title }: (typeof LESSONS)[number], html: string): Lesson {
  const whole = fragment(html);
  const steps = [...whole.querySelectorAll("section")].map((section): Step => {
    const { state = "", solve = "", beside = "", term = "" } = section.dataset;
    const text = document.createDocumentFragment();
    text.append(...section.childNodes);
    return { text, state, solve, beside, term };
  });
  return { id, title, steps, question: whole.querySelector("details") };
}

/** The project's own files, not anybody's input. */
function fragment(html: string): DocumentFragment {
  const template = document.createElement("template");
  template.innerHTML = html;
  return template.content;
}
