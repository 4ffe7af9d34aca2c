// What the bundler and the theme bring.

declare module "*.css";

/** Emits the document after every navigation. */
declare const document$: { subscribe: (listen: () => void) => void };
