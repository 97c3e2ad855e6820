//! Regions of a solid that are cavities: their tetrahedra are removed, and the other tetrahedra have walls
//! around them.

use std::collections::BTreeSet;

use palpate_files::scene::CavityContent;
use palpate_geometry::{NodeId, TetrahedronMesh};

use super::super::cavity::Cavity;
use super::super::model::{FiniteElementModel, FiniteElementState};
use super::answer::CavityAnswer;
use super::mesh::{Face, faces, take_walls};
use super::problem::{RegionContent, SolidProblem};
use crate::Error;

/// The tissue of a mesh, and the cavities in it.
pub(super) struct SolidMesh {
    pub(super) mesh: TetrahedronMesh,
    /// Its outer boundary.
    pub(super) outer: Vec<Face>,
    pub(super) cavities: Vec<SolidCavity>,
}

/// A cavity in a mesh.
pub(super) struct SolidCavity {
    /// Number of its region among those of the problem, from 0.
    region: usize,
    content: CavityContent,
    wall: Cavity,
}

impl SolidMesh {
    /// The part of `mesh` that is no cavity; its regions are those of the `problem` from 1.
    pub(super) fn new(problem: &SolidProblem, mesh: TetrahedronMesh) -> Result<Self, Error> {
        let regions = problem.regions.iter().enumerate();
        let contents = regions.filter_map(|(region, own)| match own.content {
            RegionContent::Cavity(content) => Some((region, content)),
            RegionContent::Tissue { .. } => None,
        });
        let contents: Vec<_> = contents.collect();
        if contents.is_empty() {
            return Ok(Self {
                outer: faces(&mesh),
                mesh,
                cavities: Vec::new(),
            });
        }
        let numbers: Vec<_> = contents.iter().map(|(at, _)| *at as u32 + 1).collect();
        let hollow = mesh.without(&numbers)?;
        let mut outer = faces(&hollow.mesh);
        let walls = take_walls(&mut outer, &hollow.walls);
        let each = contents.into_iter().zip(walls);
        let cavities = each.map(|((region, content), wall)| SolidCavity {
            region,
            content,
            wall: Cavity {
                // Of the body, not of the cavity.
                sides: wall
                    .iter()
                    .map(|face| face.seen_from_inside().to_vec())
                    .collect(),
            },
        });
        let cavities = cavities.collect();
        Ok(Self {
            mesh: hollow.mesh,
            outer,
            cavities,
        })
    }

    /// Corners of its outer boundary, ascending.
    pub(super) fn surface(&self) -> Vec<usize> {
        let corners = self.outer.iter().flat_map(|face| face.corners);
        let corners: BTreeSet<_> = corners.map(NodeId::index).collect();
        corners.into_iter().collect()
    }

    /// The walls of cavities that are full of a fluid, with its pressure while nothing else loads the body [Pa].
    pub(super) fn fluids(&self) -> impl Iterator<Item = (&Cavity, f64)> {
        self.cavities.iter().filter_map(|own| match own.content {
            CavityContent::Fluid(pressure) => Some((&own.wall, pressure)),
            CavityContent::Pressure(_) => None,
        })
    }

    /// The pressures [Pa] in the other cavities.
    pub(super) fn pressures(&self) -> impl Iterator<Item = (&Cavity, f64)> {
        self.cavities.iter().filter_map(|own| match own.content {
            CavityContent::Pressure(pressure) => Some((&own.wall, pressure)),
            CavityContent::Fluid(_) => None,
        })
    }

    /// The deformed cavities.
    pub(super) fn answers(
        &self,
        model: &FiniteElementModel,
        state: &FiniteElementState,
    ) -> Vec<CavityAnswer> {
        let mut fluids = model.fluids().map(|(_, unknown)| state.unknowns[unknown]);
        let each = self.cavities.iter().map(|own| {
            let volume_at_rest = own.wall.volume_at_rest(model);
            CavityAnswer {
                region: own.region,
                pressure: match own.content {
                    CavityContent::Pressure(pressure) => pressure,
                    CavityContent::Fluid(_) => fluids.next().unwrap_or(f64::NAN),
                },
                volume_at_rest,
                volume: volume_at_rest + own.wall.growth(model, &state.unknowns),
            }
        });
        each.collect()
    }
}
