// Sentences that are made of a result and of nothing else, so that none can say what its result does not have; and the steps of
// the story, each with a case, what its sentence tells, and a question with the result that answers it.
// What sentences are made of: the effective fraction as it was found, and the case.
function factsOf(found, state) {
  const top = state.storeys - 1;
  const motions = found.slides.length;
  const slides = found.slides.reduce((sum, one) => sum + one, 0);
  const model = valueAt(state.counted, found.model);
  return {
    share: found.value, counted: state.counted, motions, slides, code: model / found.realMean, storeys: state.storeys,
    roof: found.realByStorey[top] / found.modelByStorey[top],
    both: found.realByStorey[top] / Math.max(found.modelByStorey[top], found.bareByStorey[top]),
    mu: state.muS, intensity: state.intensity,
  };
}
// "12 % more than", "as much as".
function comparedWith(ratio) {
  const apart = Math.round(100 * (ratio - 1));
  return apart === 0 ? "as much as" : `${Math.abs(apart)} % ${apart > 0 ? "more" : "less"} than`;
}
const TOLD = {
  slides: ({ slides, motions, share }) =>
    slides === 0
      ? `No goods slide under any of the ${motions} motions, so that all of them act as mass.`
      : `Goods slide under ${slides === motions ? `all ${motions} motions` : `${slides} of the ${motions} motions`}, and ${per100(share)} of them act as mass.`,
  code: ({ share, counted, code }) =>
    `${per100(share)} of the goods act as mass and the code counts ${per100(counted)}: its model drifts ${comparedWith(code)} the building with the goods as they are.`,
  roof: ({ share, storeys, roof, both }) =>
    `Storey ${storeys}, the highest, drifts ${fixed(roof, 2)} times the model with ${per100(share)} of the goods attached; with a second analysis without goods, ${fixed(both, 2)} times the larger of the two.`,
};
// By how much the page of a building file has another share than this page, which has the same case or another one. `words` are
// those of what is different here.
function fileWords({ share, low, high, motions, differs }, found, isSame, words) {
  const there = `The page of the building file says ${per100(share)} (${per100(low)} to ${per100(high)}, other suites too) under ${motions} ${motions === 1 ? "motion" : "motions"}.`;
  if (!isSame) return `${there} The case was changed since.`;
  const reasons = differs.map((key) => words[key]).filter(Boolean).join("; ");
  if (found === null) return there;
  const apart = Math.round(100 * found.value) - Math.round(100 * share);
  const here = apart === 0 ? "Here it is the same" : `Here it is ${per100(found.value)}, ${Math.abs(apart)} ${Math.abs(apart) === 1 ? "point" : "points"} ${apart > 0 ? "more" : "less"}`;
  return `${there} ${here}${reasons ? `. What is different here: ${reasons}` : ""}.`;
}

// Which model of the race comes nearest, under the motion that is shown.
function raceWords({ own, nearest, counter }, motion) {
  if (nearest === null) return `Under ${motion} ${own.run.end[1] > 0 ? "the building with the goods as they are" : "each of the models"} collapses: there are no drifts to compare.`;
  const ratio = nearest.run.peakDrift[counter] / own.run.peakDrift[counter];
  return `Under ${motion} the model with ${per100(nearest.share)} of the goods attached (${nearest.name}) comes nearest: its storey ${counter + 1} drifts ${comparedWith(ratio)} that of the building with the goods as they are.`;
}

const STORIES = [
  {
    name: "Pallets on steel", address: "n=2&T=0.4&a=1.2,0&s=0.25&k=0.2&R=4&m=synthetic-2&d=code&y=1", tells: "slides",
    asks: "From which friction on does none of them slide? Drag the grip beside a block.",
    isAnswered: ({ slides }) => slides === 0,
    now: ({ mu, slides, motions }) => `Friction ${general(mu[0], 3)}: they slide under ${slides} of ${motions} motions`,
  },
  {
    name: "A library", address: "n=3&T=0.45&a=0.7,0.7,0&s=0.6&k=0.5&R=4&m=synthetic-1&d=full&y=1", tells: "slides",
    asks: "How strong must the shaking be until the first shelf slides? Drag the intensity in the sentence.",
    isAnswered: ({ slides }) => slides > 0,
    now: ({ intensity, slides, motions }) => `Intensity ${general(intensity, 3)}: they slide under ${slides} of ${motions} motions`,
  },
  {
    name: "Archive on carpet", address: "n=2&T=0.35&a=1.5,1.5&s=0.4&k=0.3&R=4&m=synthetic-1&d=full&y=1", tells: "slides",
    asks: "At which friction does less than half of the goods act as mass? Drag the grip beside a block.",
    isAnswered: ({ share }) => share < 0.5,
    now: ({ mu, share }) => `Friction ${general(mu[0], 3)}: ${per100(share)}`,
  },
  {
    name: "Slippery goods", address: "n=3&T=0.47&a=1,1,0&s=0.15&k=0.11&R=4&m=synthetic-1&d=code&y=1", tells: "code",
    asks: "From which friction on do twice as many act as mass as the code counts? Drag the grip beside a block.",
    isAnswered: ({ share, counted }) => share >= 2 * counted,
    now: ({ mu, share, counted }) => `Friction ${general(mu[0], 3)}: ${per100(share)} act as mass, ${per100(counted)} are counted`,
  },
  {
    name: "Heavy goods, one storey", address: "n=1&T=0.25&a=1.5&s=0.6&k=0.6&R=4&m=synthetic-1&d=code&y=1", tells: "code",
    asks: "At which friction is the code right to 3 points? Drag the grip beside the block.",
    isAnswered: ({ share, counted }) => Math.abs(share - counted) <= 0.03,
    now: ({ mu, share, counted }) => `Friction ${general(mu[0], 3)}: ${per100(share)} act as mass, ${per100(counted)} are counted`,
  },
  {
    name: "The roof", address: "n=4&T=0.57&a=2,2,2,0&s=0.15&k=0.15&R=4&m=synthetic-5&d=share&y=4", tells: "roof",
    asks: "At which friction does the highest storey drift at most 1.05 times the model with the share attached? Drag the grip.",
    isAnswered: ({ roof }) => roof <= 1.05,
    now: ({ mu, roof }) => `Friction ${general(mu[0], 3)}: ${fixed(roof, 2)} times`,
  },
];
// How the question of a story stands.
function questionWords(story, facts) {
  return `${story.now(facts)}. ${story.isAnswered(facts) ? "That answers it." : "Not yet."}`;
}
