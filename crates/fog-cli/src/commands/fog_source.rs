//! The fog that `optics` and `visibility` speak of.

use super::spectrum;
use crate::args::FogSourceArgs;
use crate::print;
use anyhow::{Result, bail};
use fogbank::optics::advection::AdvectionModel;
use fogbank::optics::parcel::{Amount, Family, FogParcel};
use fogbank::optics::visibility::sigma_t_from_mor;

/// Effective variance of n(r) ∝ r⁶ e^(−br).
const EFFECTIVE_VARIANCE: f64 = 1.0 / 9.0;

/// A fog.
pub(super) enum FogSource {
    /// The model's layer.
    Advection {
        model: AdvectionModel,
        height_m: f64,
        /// Meteorological optical range that is to be met at the first altitude.
        mor_m: Option<f64>,
    },
    /// The same droplets everywhere.
    Droplets { fog: FogParcel, description: String },
    /// Extinction in 1/m, whatever makes it.
    Extinction(f64),
}

impl FogSource {
    /// The fog of the arguments; warns on standard error where the model extrapolates.
    pub(super) fn new(args: &FogSourceArgs) -> Result<Self> {
        if args.model.is_some() {
            let Some(height_m) = args.height else { bail!("--model needs --height") };
            let model = AdvectionModel::arcata()?;
            model.check_height(height_m)?;
            if model.extrapolates(height_m) {
                let heights = model.measured_heights_m();
                print::complaint(format_args!(
                    "fogbank: warning: advection fog of {height_m} m is an extrapolation: the model was fitted to layers \
                     of {} to {} m",
                    heights[0],
                    heights[heights.len() - 1]
                ));
            }
            return Ok(Self::Advection { model, height_m, mor_m: args.mor });
        }
        let amounts = amounts(args);
        amounts.iter().try_for_each(Amount::check)?;
        match (&args.distribution, &amounts[..]) {
            (Some(name), _) => of_spectrum(name, &amounts),
            (None, [first, second]) => {
                let family = match args.geometric_sd {
                    Some(geometric_sd) => Family::Lognormal { geometric_sd },
                    None => Family::Gamma {
                        effective_variance: args.effective_variance.unwrap_or(EFFECTIVE_VARIANCE),
                    },
                };
                let fog = family.fog(*first, *second)?;
                let description = match family {
                    Family::Gamma { effective_variance } => {
                        format!(
                            "gamma spectrum of effective variance {effective_variance:.4} that has both amounts"
                        )
                    }
                    Family::Lognormal { geometric_sd } => {
                        format!(
                            "lognormal spectrum of geometric standard deviation {geometric_sd} that has both amounts"
                        )
                    }
                };
                Ok(Self::Droplets { fog, description })
            }
            (None, [Amount::SigmaT(sigma_t)]) => Ok(Self::Extinction(*sigma_t)),
            (None, [Amount::Mor(mor_m)]) => Ok(Self::Extinction(sigma_t_from_mor(*mor_m))),
            (None, [_]) => bail!(
                "one of --number and --lwc does not fix a fog: add --distribution, or another of --number, --lwc, --mor \
                 and --sigma"
            ),
            (None, []) => bail!(
                "which fog? Give --model advection --height M, --distribution NAME, --mor M, --sigma 1/M, or two of \
                 --number, --lwc, --mor and --sigma"
            ),
            _ => bail!("two of --number, --lwc, --mor and --sigma fix a fog; {} are given", amounts.len()),
        }
    }
}

fn amounts(args: &FogSourceArgs) -> Vec<Amount> {
    [
        args.number.map(Amount::Number),
        args.lwc.map(Amount::Water),
        args.mor.map(Amount::Mor),
        args.sigma.map(Amount::SigmaT),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn of_spectrum(name: &str, amounts: &[Amount]) -> Result<FogSource> {
    let spectrum = spectrum::read(name)?;
    let amount = match (amounts, spectrum.number_density_1_m3) {
        ([amount], _) => *amount,
        ([], Some(number)) => Amount::Number(number),
        ([], None) => {
            bail!("--distribution {name} needs an amount: one of --number, --lwc, --mor and --sigma")
        }
        _ => bail!(
            "with --distribution one of --number, --lwc, --mor and --sigma is enough; {} are given",
            amounts.len()
        ),
    };
    let fog = FogParcel::new(spectrum.distribution, amount)?;
    Ok(FogSource::Droplets { fog, description: spectrum.description })
}
