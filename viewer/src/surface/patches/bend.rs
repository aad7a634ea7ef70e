//! A patch turned and bent along the field. Lines of constant t run at the angle κs·s + κt·b to the patch's axis, as the
//! field does to first order around the seed.

use faer::c64;
use glam::{DMat2, DVec2};

use super::PatchOptions;
use super::exp_map::Visit;
use crate::params::Follow;
use crate::surface::field::Field;
use crate::surface::graph::Graph;

/// Greatest bend, over one spacing.
const GREATEST: f64 = 0.7;

/// How a patch lies along the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bend {
    /// The axis, as an angle of the seed's frame.
    pub(super) angle_rad: f64,
    /// Turns places of the seed's frame back by that angle.
    back: DVec2,
    /// Change of the direction per unit along and across, in radians.
    pub(super) rates: DVec2,
}

impl Bend {
    /// Fitted to the field at the nodes of a patch; `spacing` is the distance of seeds here.
    ///
    /// `doubled` holds the field's directions at the nodes, as e^(2iθ).
    pub(super) fn fit(
        graph: &Graph,
        field: &Field,
        doubled: &[c64],
        visits: &[Visit],
        spacing: f64,
        options: &PatchOptions,
    ) -> Self {
        let straight = |angle_rad: f64| Self { angle_rad, back: DVec2::from_angle(-angle_rad), rates: DVec2::ZERO };
        if options.follow == Follow::Light {
            return straight(0.0);
        }
        // The cell of the seed counts, where the patch is drawn alone; areas, so that dense places do not count more.
        let weight = |visit: &Visit| {
            let near = 1.0 - (visit.radius / spacing).powi(2);
            near.max(0.0) * graph.areas[visit.node as usize] * field.strengths[visit.node as usize].max(1e-3)
        };
        let doubled = |visit: &Visit| doubled[visit.node as usize] * visit.turn * visit.turn;
        let sum: c64 = visits.iter().map(|visit| doubled(visit) * weight(visit)).sum();
        if sum.norm() == 0.0 {
            return straight(visits.first().map_or(0.0, |seed| field.angles_rad[seed.node as usize]));
        }
        let angle_rad = sum.arg() / 2.0;
        let straight = straight(angle_rad);
        if !options.bent {
            return straight;
        }
        let back = c64::from_polar(1.0, -2.0 * angle_rad);
        let (mut ata, mut atb) = (DMat2::ZERO, DVec2::ZERO);
        for visit in visits {
            let place = straight.back.rotate(visit.place);
            let weight = weight(visit);
            if weight == 0.0 {
                continue;
            }
            let rest = (doubled(visit) * back).arg() / 2.0;
            ata += DMat2::from_cols(place * place.x, place * place.y) * weight;
            atb += place * (rest * weight);
        }
        // Places in one line say nothing across it.
        let floor = 1e-6 * (ata.x_axis.x + ata.y_axis.y);
        let ata = ata + DMat2::from_diagonal(DVec2::splat(floor));
        let rates = if ata.determinant() > 0.0 { ata.inverse() * atb } else { DVec2::ZERO };
        let limit = GREATEST / spacing.max(1e-12);
        Self { rates: rates.clamp(DVec2::splat(-limit), DVec2::splat(limit)), ..straight }
    }

    /// The place (s, t) of a place of the patch: strokes run along s.
    ///
    /// `t = b·exp(-κt·s) - ½κs·s²` has the wanted slope at t = 0 and never folds.
    pub(super) fn place(&self, place: DVec2) -> DVec2 {
        let place = self.back.rotate(place);
        let across = (-self.rates.y * place.x).clamp(-1.0, 1.0).exp();
        DVec2::new(place.x, place.y * across - 0.5 * self.rates.x * place.x * place.x)
    }
}
