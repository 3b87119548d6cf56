/** What the worker says by itself; all else that it says is the core's. */

export const worker = {
  own: "Your own frames",
  focalOfSequence: "f is known for this sequence.",
  focalOfLens: (lens: string) => `f is from ${lens}.`,
  focalGuessed:
    "f is unknown. As a guess it is the width of the frame: set it if you know it, or press Find f.",
  noFrames: "no frames are open; choose a sequence or open two frames",
  noTruth: "there is no ground truth for these frames",
  notLoaded: (reason: string) => `the solver cannot be loaded: ${reason}`,
};
