// What the bundler brings.

declare module "*.css";

/** What javascripts/search/ and search.js leave for each other: both are scripts of the old kind, which run from a file too. */
declare var clinicIndex: { documents: Record<string, { around: [string, string]; fields: string[]; rows: string[][] }>; synonyms: string[][]; families: import("./search/families.js").Weights };
declare var clinicAnswers: Record<string, string> | undefined;
declare var clinicSearch: (form: HTMLFormElement, site: string, fetched: (name: string) => Promise<void>) => void;
declare var clinicNearest: (path: string) => import("./search/index.js").Document | undefined;
