/**
 * The timeline under the stage: the energy along it, a range input over that which goes to any pass, steps, play, a
 * sentence on the pass shown, and a second line that goes on from there.
 */

import { announce, byId, icon, make } from "../dom";
import { look } from "../looking";
import { store, type State } from "../store";
import { text } from "../text";
import { drawChart, scalesOf, shareOf } from "./chart";
import { apartAt, flicker, flickers } from "./compare";
import { firstOf, goOn, goTo, isPlaying, onPlaying, placeOf, play, stop, walk } from "./going";
import { endOf, keptAt, lengthOf, type Timeline } from "./line";
import {
  comparison,
  differences,
  energySentence,
  lineName,
  passSaid,
  type Said,
  thinnedSentence,
} from "./sentences";

const words = text.timeline;

/** How long a pass is shown when the timeline plays, milliseconds. */
const BEATS = [2500, 1200, 500];
const USUAL = 1200;

const back = button(words.back, "step");
const playing = button(words.play, "run");
const on = button(words.forth, "step");
const beat = make("select", { "aria-label": words.beat, class: "beat" });
const chart = document.createElementNS("http://www.w3.org/2000/svg", "svg");
const scales = make("div", { class: "scales", "aria-hidden": "true" });
const range = make("input", {
  type: "range",
  id: "pass",
  min: 0,
  step: 1,
  "aria-label": words.pass,
  "aria-describedby": "energy-told",
  title: words.line,
});
const told = make("p", { id: "energy-told", role: "tooltip" }, words.line);
const sentence = make("p", { id: "pass-sentence", class: "sentence" });
const more = make("button", {
  ...{ type: "button", class: "more", "aria-label": words.whole, title: words.whole },
  ...{ "aria-expanded": "false", "aria-controls": "pass-sentence" },
});
const going = make(
  "button",
  { type: "button", id: "go-on" },
  words.goOn,
  make("span", {}, `\u00a0${words.fromHere}`),
);
const lines = make("fieldset", { class: "segments small" });
const turns = make(
  "button",
  { type: "button", id: "flicker", "aria-pressed": "false" },
  words.flicker,
);
const pair = make(
  "button",
  {
    type: "button",
    id: "beside",
    "aria-pressed": "false",
    title: words.besideTitle,
  },
  words.beside,
);
const apart = make("p", { id: "apart", class: "apart" });
const two = make("div", { class: "two-lines", hidden: true }, lines, turns, pair, apart);

function button(name: string, picture: string): HTMLButtonElement {
  const title = { title: name, "aria-label": name };
  return make("button", { type: "button", class: "icon-only", ...title }, icon(picture));
}

export function mountTimeline(): void {
  beat.append(
    ...BEATS.map((value) =>
      make("option", { value, selected: value === USUAL }, words.beats(value / 1000)),
    ),
  );
  chart.setAttribute("class", "energy-line");
  chart.setAttribute("aria-hidden", "true");
  byId("timeline").append(
    make(
      "div",
      { class: "time-row" },
      make("div", { class: "steps" }, back, playing, on),
      make("div", { class: "track" }, scales, chart, range, told),
      beat,
    ),
    make("div", { class: "time-words" }, sentence, going),
    two,
  );
  range.addEventListener("input", () => {
    rest();
    want(Number(range.value));
  });
  back.addEventListener("click", () => void step(-1));
  on.addEventListener("click", () => void step(1));
  playing.addEventListener("click", () => {
    flickering(false);
    if (isPlaying()) stop();
    else void play(() => Number(beat.value));
  });
  onPlaying((plays) => {
    playing.replaceChildren(icon(plays ? "pause" : "run"));
    playing.title = plays ? words.stop : words.play;
    playing.ariaLabel = playing.title;
  });
  more.addEventListener("click", () => {
    more.ariaExpanded = String(sentence.classList.toggle("whole"));
  });
  going.addEventListener("click", () => {
    rest();
    void goOn();
  });
  turns.addEventListener("click", () => {
    stop();
    flickering(!flickers());
  });
  pair.addEventListener("click", () => {
    rest();
    const { beside, view } = store.state;
    const on = !beside || view !== "relief";
    store.update({ beside: on, ...(on ? { view: "relief" } : {}) });
    void look();
  });
  store.watch(
    ({ beside, view }) => [beside, view],
    ({ beside, view }) => {
      pair.ariaPressed = String(beside && view === "relief");
    },
  );
  lines.addEventListener("change", (event) => {
    rest();
    const line = Number((event.target as HTMLInputElement).value);
    void goTo({ line, at: placeOf(store.state).at });
  });
  store.watchAfter(
    ({ timeline, visit, started, running, busy, report }) => [
      ...[timeline, visit, started, running, busy, report],
    ],
    (state) => {
      if (state.timeline !== lined) drawLines(state);
      lined = state.timeline;
      show(state);
    },
    true,
  );
  // Curves drawn anew, or another camera, are of the start.
  store.watch(
    ({ shapes, camera }) => [shapes, camera],
    () => {
      rest();
      const { visit, timeline } = store.state;
      if (visit && timeline) void goTo({ line: timeline.lines.length - 1, at: Infinity });
    },
  );
}

async function step(by: number): Promise<void> {
  rest();
  await walk(by);
  announce(sentence.textContent ?? "");
}

/** Nothing moves by itself. */
function rest(): void {
  stop();
  flickering(false);
}

function flickering(on: boolean): void {
  if (on === flickers()) return;
  flicker(on);
  turns.ariaPressed = String(on);
}

let wanted: number | null = null;

/** Goes there with the next display refresh, the last of those wanted by then. */
function want(at: number): void {
  if (wanted === null) {
    requestAnimationFrame(() => {
      const at = wanted!;
      wanted = null;
      void goTo({ line: placeOf(store.state).line, at });
    });
  }
  wanted = at;
}

/** The timeline whose lines are named. */
let lined: Timeline | null | undefined;

function drawLines(state: Readonly<State>): void {
  const { timeline } = state;
  byId("timeline").hidden = timeline === null;
  if (!timeline) {
    if (state.beside) store.update({ beside: false });
    return rest();
  }
  range.min = String(firstOf(state));
  range.max = String(lengthOf(timeline));
  two.hidden = timeline.lines.length < 2;
  if (two.hidden) {
    if (state.beside) store.update({ beside: false });
    return flickering(false);
  }
  lines.replaceChildren(
    make("legend", { class: "visually-hidden" }, words.lineShown),
    ...timeline.lines.map((line, i) =>
      make(
        "label",
        { class: `line-${i}` },
        make("input", { type: "radio", name: "line", value: i }),
        make("span", {}, lineName(timeline, line, i > 0)),
      ),
    ),
  );
}

/** What the chart was drawn for. */
let drawn: [Timeline, number] | null = null;

function show(state: Readonly<State>): void {
  const { timeline, running, busy } = state;
  if (!timeline) return;
  const place = placeOf(state);
  const line = timeline.lines[place.line]!;
  if (drawn?.[0] !== timeline || drawn[1] !== place.line) {
    drawChart(chart, timeline, place.line);
    scales.replaceChildren(...tags(scalesOf(timeline, place.line)));
    drawn = [timeline, place.line];
  }
  const end = endOf(timeline, line);
  const kept = keptAt(timeline, place);
  // Where the solver stands, it says so itself.
  const own = state.visit ? null : state.report;
  const at = own ? place.at : (kept?.at ?? place.at);
  const report = place.at > timeline.first ? (own ?? kept?.pass.report) : null;
  range.value = String(place.at);
  range.style.setProperty("--share", String(shareOf(timeline, place.at)));
  range.dataset["line"] = String(place.line);
  const left = report ? energySentence(timeline, line, at) : "";
  say([
    ...(report ? passSaid(timeline, line, at, report) : [{ words: words.start, aside: false }]),
    { words: `${report ? thinnedSentence(place.at, at) : ""} ${left}`, aside: false },
  ]);
  range.setAttribute("aria-valuetext", report ? words.place(at, end, left) : words.startShort);
  const choice = lines.querySelector<HTMLInputElement>(`input[value="${place.line}"]`);
  if (choice) choice.checked = true;
  back.disabled = place.at <= firstOf(state);
  on.disabled = place.at >= end;
  playing.disabled = end <= firstOf(state);
  going.disabled = state.visit === null || busy !== null;
  going.title = going.disabled ? words.goBackFirst : words.goOnTitle;
  compare(timeline, place.at, running);
}

/** The name of a scale, where it begins. */
/** The name of a scale where it begins, the number alone where the next begins soon. */
function tags(begins: { share: number; name: string }[]): HTMLElement[] {
  return begins.map(({ share, name }, i) => {
    const word = make("span", { class: "word" }, `${words.scale} `);
    const element = make("div", {}, make("span", {}, word, name));
    element.style.left = `${100 * share}%`;
    element.style.width = `${100 * ((begins[i + 1]?.share ?? 1) - share)}%`;
    return element;
  });
}

/** What there is little room for comes with a press. */
function say(parts: Said[]): void {
  more.hidden = !parts.some(({ words, aside }) => aside && words);
  sentence.replaceChildren(
    ...parts.map(({ words, aside }) => make("span", { class: aside ? "aside" : null }, words)),
    more,
  );
}

let compared = 0;

/** How far the two lines are apart here, once nobody moves along them. */
function compare(timeline: Timeline, at: number, running: boolean): void {
  const [one, other] = timeline.lines;
  if (running) apart.textContent = "";
  if (!one || !other || running) return;
  const mine = ++compared;
  setTimeout(async () => {
    if (mine !== compared || flickers()) return;
    const share = await apartAt(timeline, at);
    if (mine !== compared) return;
    const [before, after] = [one, other].map(
      (line) => line.passes.at(-1)?.pass.setup.options ?? {},
    );
    const labels = store.state.catalogues?.options ?? [];
    apart.textContent = comparison(timeline, at, share, differences(before!, after!, labels));
  }, 250);
}
