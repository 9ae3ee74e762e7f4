//! Water, Mie series, droplet-size distributions, polydisperse averages and visibility laws
