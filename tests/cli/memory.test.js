// Many solves in one instance; `node bench/long.js` makes ten thousand.

import assert from "node:assert/strict";
import { test } from "node:test";

import { solves } from "../../bench/long.js";

test("memory stays as it is once every kind of solve has been made", () => {
  const sizes = solves(160);
  assert.equal(sizes.at(-1), sizes[39], "bytes");
});
