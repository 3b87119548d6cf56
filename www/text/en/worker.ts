/** What the worker says by itself; all else that it says is the core's. */

export const worker = {
  own: "Your own frames",
  focalOfSequence: "f is the sequence's own.",
  focalOfLens: (lens: string) => `f is from ${lens}.`,
  focalGuessed: "f is a guess: the frame's width.",
  noFrames: "no frames are open; pick a sequence or open two frames",
  noTruth: "the truth of these frames is not known",
  notLoaded: (reason: string) => `the core cannot be loaded: ${reason}`,
};
