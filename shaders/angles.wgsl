// Parts of the circle.

const TAU: f32 = 6.2831855;
const FRAC_1_PI: f32 = 0.31830988;
