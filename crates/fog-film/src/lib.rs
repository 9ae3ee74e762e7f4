//! Pixel moments, AOV channels and sensor response
