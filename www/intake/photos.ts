/** Three or more photos, in the order of their names, as if they were a film. */

import { ask } from "../session";
import { text } from "../text";
import { admit } from "./admit";
import type { Film } from "./film";

/** A film of files; pictures that are no good say so when they are looked at. */
export function photos(files: File[]): Film {
  const unnamed = (index: number) => text.files.unnamedPicture(index + 1);
  const label = (index: number) => files[index]!.name || unnamed(index);
  const file = (index: number) => admit(files[index]!, unnamed(index));
  return {
    name: text.files.pictures(files.length),
    count: files.length,
    label,
    file,
    async picture(index, longest) {
      const read = await file(index);
      const seen = await ask(null, (service) => service.preview(read, longest));
      if (!seen) throw new Error(text.files.notShown(label(index)));
      return seen.picture;
    },
    close() {},
  };
}
