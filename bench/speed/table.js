// Tables in Markdown, aligned so that they can be read as they are.

/**
 * The first column is set flush left, the others flush right.
 * @param {string[]} head
 * @param {string[][]} rows
 */
export function table(head, rows) {
  const widths = head.map((_, i) => Math.max(...[head, ...rows].map((row) => length(row[i]))));
  const line = (/** @type {string[]} */ cells) =>
    `| ${widths.map((width, i) => padded(cells[i] ?? "", width, i > 0)).join(" | ")} |`;
  const rule = widths.map((width, i) => "-".repeat(i ? width - 1 : width) + (i ? ":" : ""));
  return [line(head), `| ${rule.join(" | ")} |`, ...rows.map(line)].join("\n");
}

/**
 * @param {string} text
 * @param {number} width
 * @param {boolean} right
 */
function padded(text, width, right) {
  const blanks = " ".repeat(width - length(text));
  return right ? blanks + text : text + blanks;
}

/** @param {string | undefined} text */
function length(text = "") {
  return [...text].length;
}

/**
 * A number to three figures at least, none as a dash.
 * @param {number | null | undefined} value
 * @param {number} [digits]
 */
export function number(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value === 0) return "0";
  const places = digits - 1 - Math.floor(Math.log10(Math.abs(value)));
  return value.toFixed(Math.min(Math.max(places, 0), 6));
}

/**
 * A share in percent.
 * @param {number | null | undefined} share
 */
export function percent(share) {
  return share === null || share === undefined ? "–" : (100 * share).toFixed(1);
}
