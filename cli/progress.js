// A bar on the terminal while the solver runs; nothing when stderr is no terminal.

const CELLS = 24;
const INTERVAL_MS = 80;

/** @param {number} most passes at which the solver gives up */
export function progress(most) {
  const terminal = process.stderr.isTTY;
  let last = -Infinity;
  return {
    /** @param {number} passes */
    show(passes) {
      if (!terminal || performance.now() - last < INTERVAL_MS) return;
      last = performance.now();
      const full = Math.min(CELLS, Math.round((CELLS * passes) / most));
      const bar = "█".repeat(full) + "░".repeat(CELLS - full);
      process.stderr.write(`\r\x1b[K${bar} pass ${passes} of at most ${most}`);
    },
    clear() {
      if (terminal) process.stderr.write("\r\x1b[K");
    },
  };
}
