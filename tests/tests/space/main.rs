//! Pictures of scenes of space against closed forms and f64 references of our own: where planes, lines, layers and light
//! have to be.

mod additive;
mod camera;
mod colour;
mod columns;
mod cutaway;
mod drawing;
mod extremes;
mod glow;
mod lights;
mod lines;
mod nested;
mod projection;
mod scatter;
mod slices;
mod transparency;
mod volume;
