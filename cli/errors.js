// The two ways in which a command can fail.

/** The command line cannot be understood: exit code 2. */
export class UsageError extends Error {}

/** What it names cannot be worked on: exit code 1. */
export class InputError extends Error {}
