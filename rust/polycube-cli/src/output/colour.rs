//! Colours that tell neighbours apart.

/// Red, green and blue, 0 to 1.
pub type Colour = [f32; 3];

/// The colour of the lines.
pub const INK: Colour = [0.10, 0.10, 0.13];

/// A light colour for the number `id`; numbers that follow each other get colours far apart. The page has the same.
pub fn pastel(id: u32) -> Colour {
    let hue = (f64::from(id) * 0.618_034 + 0.08).fract() as f32;
    let lightness = [0.84, 0.74, 0.79][id as usize % 3];
    from_hsl(hue, 0.62, lightness)
}

/// The same in bytes.
pub fn bytes(colour: Colour) -> [u8; 3] {
    colour.map(|x| (x * 255.0).round() as u8)
}

fn from_hsl(hue: f32, saturation: f32, lightness: f32) -> Colour {
    let amplitude = saturation * lightness.min(1.0 - lightness);
    [0.0, 8.0, 4.0].map(|offset: f32| {
        let k = (offset + hue * 12.0) % 12.0;
        lightness - amplitude * (k - 3.0).min(9.0 - k).clamp(-1.0, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_light_and_neighbours_differ() {
        for id in 0..100 {
            let (a, b) = (pastel(id), pastel(id + 1));
            assert!(a.iter().all(|x| (0.3..=1.0).contains(x)), "{a:?}");
            assert!(a.iter().zip(b).map(|(x, y)| (x - y).abs()).sum::<f32>() > 0.2, "{id}");
        }
    }

    #[test]
    fn known_colours() {
        let near = |a: Colour, b: Colour| a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-6);
        assert!(near(from_hsl(0.0, 1.0, 0.5), [1.0, 0.0, 0.0]));
        assert!(near(from_hsl(1.0 / 3.0, 1.0, 0.5), [0.0, 1.0, 0.0]));
        assert!(near(from_hsl(0.5, 0.0, 0.7), [0.7; 3]));
    }
}
