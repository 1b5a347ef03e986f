//! The crate format, version 0.8.0: how USD keeps a layer in binary.
//!
//! A bootstrap of 88 bytes says where the table of contents is. Values come behind it; what is
//! small is not a value of its own but stands in the 64 bits that refer to it: flags (array,
//! inlined) and a type in the upper 16, the value or its address in the lower 48. The structure
//! follows: tokens; strings, fields (a name and a value), sets of fields ended by -1, paths in the
//! order of a walk through the tree, and specs (a path, a set of fields, a kind).
//!
//! The structure must be compressed with LZ4. It is some hundred bytes here, so it is written as
//! LZ4 that consists of literals only, which every decoder takes; values are not compressed.

use std::collections::HashMap;
use std::io::{self, Seek, SeekFrom, Write};

/// Magic and version 0.8.0, the address of the table of contents not known yet.
const BOOTSTRAP: [u8; 88] = {
    let mut bytes = [0; 88];
    let begin = *b"PXR-USDC\x00\x08\x00";
    let mut i = 0;
    while i < begin.len() {
        bytes[i] = begin[i];
        i += 1;
    }
    bytes
};
/// Where the address of the table of contents stands.
const CONTENTS: u64 = 16;
/// Arrays begin at multiples of this, so that readers can use them where they lie.
const ALIGNMENT: u64 = 8;

const ARRAY: u64 = 1 << 63;
const INLINED: u64 = 1 << 62;

/// The types of values that are written, as the format numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Int = 3,
    Int64 = 5,
    Float = 8,
    Double = 9,
    Token = 11,
    Vec2f = 20,
    Vec3f = 24,
    Vec4f = 28,
    TokenVector = 41,
    Specifier = 42,
    Variability = 44,
    TimeSamples = 46,
    DoubleVector = 48,
}

/// A value, or where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rep(u64);

impl Rep {
    const fn new(flags: u64, kind: Type, payload: u64) -> Self {
        Self(flags | (kind as u64) << 48 | payload)
    }

    /// A small number that stands for itself.
    pub(super) const fn inlined(kind: Type, payload: u32) -> Self {
        Self::new(INLINED, kind, payload as u64)
    }
}

/// What a spec describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Attribute = 1,
    Prim = 6,
    Root = 7,
}

/// A layer of nested prims, each but the last with one child, the last with attributes.
pub(super) struct CrateFile<W> {
    out: W,
    end: u64,
    tokens: Vec<String>,
    indices: HashMap<String, i32>,
    fields: Vec<(i32, Rep)>,
    field_sets: Vec<i32>,
    specs: Vec<Spec>,
}

struct Spec {
    /// The last part of its path; negative for attributes.
    element: i32,
    field_set: i32,
    kind: Kind,
}

impl<W: Write + Seek> CrateFile<W> {
    pub(super) fn new(mut out: W) -> io::Result<Self> {
        out.seek(SeekFrom::Start(0))?;
        out.write_all(&BOOTSTRAP)?;
        let mut file = Self {
            out,
            end: BOOTSTRAP.len() as u64,
            tokens: Vec::new(),
            indices: HashMap::new(),
            fields: Vec::new(),
            field_sets: Vec::new(),
            specs: Vec::new(),
        };
        // Elements of attributes are the negatives of their tokens, which 0 has none of.
        file.index(";-)");
        Ok(file)
    }

    fn index(&mut self, token: &str) -> i32 {
        if let Some(&index) = self.indices.get(token) {
            return index;
        }
        let index = i32::try_from(self.tokens.len()).unwrap_or(i32::MAX);
        self.tokens.push(token.to_owned());
        self.indices.insert(token.to_owned(), index);
        index
    }

    /// A token.
    pub(super) fn token(&mut self, token: &str) -> Rep {
        Rep::inlined(Type::Token, self.index(token).unsigned_abs())
    }

    /// Tokens.
    pub(super) fn token_vector(&mut self, tokens: &[String]) -> io::Result<Rep> {
        let indices = tokens.iter().flat_map(|token| self.index(token).to_le_bytes());
        let bytes: Vec<u8> = indices.collect();
        let address = self.counted(tokens.len(), &bytes)?;
        Ok(Rep::new(0, Type::TokenVector, address))
    }

    /// A number, in place if 32 bits hold it.
    pub(super) fn double(&mut self, number: f64) -> io::Result<Rep> {
        #[expect(clippy::cast_possible_truncation, reason = "whether it fits is what is asked")]
        let short = number as f32;
        if f64::from(short).to_bits() == number.to_bits() {
            return Ok(Rep::inlined(Type::Double, short.to_bits()));
        }
        let address = self.aligned()?;
        self.put(&number.to_le_bytes())?;
        Ok(Rep::new(0, Type::Double, address))
    }

    /// An array of `count` items.
    pub(super) fn array(&mut self, kind: Type, count: usize, bytes: &[u8]) -> io::Result<Rep> {
        if count == 0 {
            return Ok(Rep::new(ARRAY, kind, 0));
        }
        let address = self.counted(count, bytes)?;
        Ok(Rep::new(ARRAY, kind, address))
    }

    /// Values over time.
    pub(super) fn time_samples(&mut self, samples: &[(f64, Rep)]) -> io::Result<Rep> {
        let times: Vec<u8> = samples.iter().flat_map(|(time, _)| time.to_le_bytes()).collect();
        let times = self.counted(samples.len(), &times)?;
        let times = Rep::new(0, Type::DoubleVector, times);
        let address = self.aligned()?;
        // What comes next is so far from here: the format lets values stand in between.
        let jump = 8_u64.to_le_bytes();
        self.put(&jump)?;
        self.put(&times.0.to_le_bytes())?;
        self.put(&jump)?;
        self.put(&(samples.len() as u64).to_le_bytes())?;
        for (_, rep) in samples {
            self.put(&rep.0.to_le_bytes())?;
        }
        Ok(Rep::new(0, Type::TimeSamples, address))
    }

    /// Describes the next thing in the order of the walk: the root, a prim in the last one, an
    /// attribute of the last prim.
    pub(super) fn spec(&mut self, kind: Kind, name: &str, fields: &[(&str, Rep)]) {
        let token = self.index(name);
        let element = if kind == Kind::Attribute { -token } else { token };
        let field_set = i32::try_from(self.field_sets.len()).unwrap_or(i32::MAX);
        for (name, rep) in fields {
            let field = (self.index(name), *rep);
            let known = self.fields.iter().position(|known| *known == field);
            let index = known.unwrap_or_else(|| {
                self.fields.push(field);
                self.fields.len() - 1
            });
            self.field_sets.push(i32::try_from(index).unwrap_or(i32::MAX));
        }
        self.field_sets.push(-1);
        self.specs.push(Spec { element, field_set, kind });
    }

    /// Writes the structure.
    pub(super) fn finish(mut self) -> io::Result<W> {
        let sections = self.sections();
        let mut contents = Vec::new();
        push_words(&mut contents, &[sections.len()]);
        for (name, bytes) in &sections {
            let mut padded = [0; 16];
            padded[..name.len()].copy_from_slice(name.as_bytes());
            contents.extend(padded);
            contents.extend(self.end.to_le_bytes());
            push_words(&mut contents, &[bytes.len()]);
            self.put(bytes)?;
        }
        let address = self.end;
        self.put(&contents)?;
        self.out.seek(SeekFrom::Start(CONTENTS))?;
        self.out.write_all(&address.to_le_bytes())?;
        self.out.seek(SeekFrom::Start(self.end))?;
        self.out.flush()?;
        Ok(self.out)
    }

    /// The parts of the structure, by name.
    fn sections(&self) -> [(&'static str, Vec<u8>); 6] {
        let mut tokens = self.tokens.join("\0").into_bytes();
        tokens.push(0);
        let packed = literals(&tokens);
        let mut token_section = Vec::new();
        push_words(&mut token_section, &[self.tokens.len(), tokens.len(), packed.len()]);
        token_section.extend(packed);

        let names: Vec<i32> = self.fields.iter().map(|field| field.0).collect();
        let reps: Vec<u8> = self.fields.iter().flat_map(|field| field.1.0.to_le_bytes()).collect();
        let mut field_section = counted_integers(&names);
        push_block(&mut field_section, &literals(&reps));

        let n = self.specs.len();
        let in_order: Vec<i32> = (0..).take(n).collect();
        let column = |of: fn(&Spec) -> i32| self.specs.iter().map(of).collect::<Vec<i32>>();
        let mut path_section = Vec::new();
        push_words(&mut path_section, &[n]);
        path_section.extend(counted_integers(&in_order));
        push_block(&mut path_section, &integers(&column(|spec| spec.element)));
        push_block(&mut path_section, &integers(&self.jumps()));

        let mut spec_section = counted_integers(&in_order);
        push_block(&mut spec_section, &integers(&column(|spec| spec.field_set)));
        push_block(&mut spec_section, &integers(&column(|spec| spec.kind as i32)));
        [
            ("TOKENS", token_section),
            // There are no strings but tokens: a count of 0.
            ("STRINGS", vec![0; 8]),
            ("FIELDS", field_section),
            ("FIELDSETS", counted_integers(&self.field_sets)),
            ("PATHS", path_section),
            ("SPECS", spec_section),
        ]
    }

    /// What comes behind each path: its child (-1), a sibling (0), or neither (-2).
    fn jumps(&self) -> Vec<i32> {
        let next = |i: usize| match (self.specs[i].kind, self.specs.get(i + 1)) {
            (Kind::Root | Kind::Prim, _) => -1,
            (Kind::Attribute, Some(_)) => 0,
            (Kind::Attribute, None) => -2,
        };
        (0..self.specs.len()).map(next).collect()
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.end += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    fn aligned(&mut self) -> io::Result<u64> {
        let padding = self.end.next_multiple_of(ALIGNMENT) - self.end;
        self.put(&[0; 8][..usize::try_from(padding).unwrap_or_default()])?;
        Ok(self.end)
    }

    /// A count and what it counts.
    fn counted(&mut self, count: usize, bytes: &[u8]) -> io::Result<u64> {
        let address = self.aligned()?;
        self.put(&(count as u64).to_le_bytes())?;
        self.put(bytes)?;
        Ok(address)
    }
}

fn push_words(bytes: &mut Vec<u8>, words: &[usize]) {
    bytes.extend(words.iter().flat_map(|&word| (word as u64).to_le_bytes()));
}

fn push_block(bytes: &mut Vec<u8>, block: &[u8]) {
    push_words(bytes, &[block.len()]);
    bytes.extend(block);
}

/// How many integers there are, and they.
fn counted_integers(values: &[i32]) -> Vec<u8> {
    let mut bytes = Vec::new();
    push_words(&mut bytes, &[values.len()]);
    push_block(&mut bytes, &integers(values));
    bytes
}

/// Integers as the format codes them: the difference from the one before that is most common, two
/// bits for each integer that say how its difference is written, and the differences. Here all are
/// written in full (code 3).
fn integers(values: &[i32]) -> Vec<u8> {
    let mut coded = 0_i32.to_le_bytes().to_vec();
    // The bits behind the last integer stay clear: openusd 0.6 reads them too.
    let codes = values.chunks(4).map(|four| 0xff_u8 >> (8 - 2 * four.len()));
    coded.extend(codes);
    let mut before = 0_i32;
    for &value in values {
        coded.extend(value.wrapping_sub(before).to_le_bytes());
        before = value;
    }
    literals(&coded)
}

/// LZ4 of one chunk without matches: how many literals there are, and they.
fn literals(bytes: &[u8]) -> Vec<u8> {
    const IN_TOKEN: usize = 15;
    let mut packed = vec![0];
    packed.push(u8::try_from(bytes.len().min(IN_TOKEN) << 4).unwrap_or(u8::MAX));
    if let Some(mut more) = bytes.len().checked_sub(IN_TOKEN) {
        while let Some(rest) = more.checked_sub(0xff) {
            packed.push(0xff);
            more = rest;
        }
        packed.push(u8::try_from(more).unwrap_or_default());
    }
    packed.extend(bytes);
    packed
}
