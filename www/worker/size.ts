/** How large the page has things drawn: quickly at first, then as its screen can show them. */

/** Frames with more pixels are drawn smaller. */
const MOST_PIXELS = 4e6;
/** A first picture has no more, so that it is there in a blink: about as many as *Detail* works on by default. */
const QUICK_PIXELS = 6e5;
/** A picture may be by an eighth smaller than the screen, or less. */
const SMALLER = 0.25;
/** Maps of errors are drawn at the frames' size, since what is seen is what is counted. */
export const ERROR = "error-";

/** How large something is drawn, as the core's `pixels`. */
export interface Size {
  pixels: number;
  /** Whether a screen could show more. */
  blunt: boolean;
}

/**
 * The size of a picture of frames with those sides: as large as a screen can use that shows it `longest` pixels long, or as
 * one that must be quick may be.
 */
export function sizeOf(
  { width, height }: { width: number; height: number },
  kind: string,
  longest: number,
  quick: boolean,
): Size {
  // By a whole number, as the core shrinks them, and hardly smaller than the screen.
  const factor = Math.max(1, Math.floor(Math.max(width, height) / longest + SMALLER));
  const pixels = Math.min(MOST_PIXELS, Math.ceil((width * height) / factor ** 2));
  const blunt = quick && !kind.startsWith(ERROR) && Math.min(pixels, width * height) > QUICK_PIXELS;
  return { pixels: blunt ? QUICK_PIXELS : pixels, blunt };
}

/** The relief's size: its vertices are fewer still. */
export const MESH_PIXELS = QUICK_PIXELS;
/** The same to be taken away. */
export const FILE_PIXELS = MOST_PIXELS;
