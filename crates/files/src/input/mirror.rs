//! Both ways between a file and the model in SI: one list of pairs for reading and writing.

use coil::Contact;

/// A part of a case file that says the same as an `M` of the model.
pub(crate) trait Mirror<M> {
    /// The model's part, in SI.
    fn model(&self) -> M;

    /// The file's form of `model`.
    fn of(model: &M) -> Self;
}

/// Groups of fields, each the mirror of one of the model's: `key: Type = field`; `[part: Part { .. }]` holds those of a part of the model.
macro_rules! mirrored {
    ($($(#[$about:meta])* $file:ident is $model:ident {
        $([$part:ident: $of_part:ident { $($(#[$in_of:meta])* $in_key:ident: $in_type:ty = $in_field:ident,)* }])?
        $($(#[$of:meta])* $key:ident: $type:ty = $field:ident,)*
    })*) => {$(
        #[derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(deny_unknown_fields)]
        $(#[$about])*
        pub(crate) struct $file {
            $($($(#[$in_of])* pub(crate) $in_key: $in_type,)*)?
            $($(#[$of])* pub(crate) $key: $type,)*
        }

        impl $crate::input::mirror::Mirror<$model> for $file {
            fn model(&self) -> $model {
                $model {
                    $($part: $of_part { $($in_field: $crate::input::mirror::Mirror::model(&self.$in_key)),* },)?
                    $($field: $crate::input::mirror::Mirror::model(&self.$key)),*
                }
            }

            fn of(model: &$model) -> Self {
                Self {
                    $($($in_key: $crate::input::mirror::Mirror::of(&model.$part.$in_field),)*)?
                    $($key: $crate::input::mirror::Mirror::of(&model.$field)),*
                }
            }
        }
    )*};
}

/// Choices that have the model's own names.
macro_rules! mirrored_choice {
    ($($(#[$about:meta])* $file:ident is $($model:ident),+: $names:tt)*) => {$(
        mirrored_choice!(@type $(#[$about])* $file $names);
        $(mirrored_choice!(@mirror $file $model $names);)+
    )*};
    (@type $(#[$about:meta])* $file:ident { $($name:ident),* }) => {
        #[derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema, Clone, Copy)]
        $(#[$about])*
        pub(crate) enum $file { $($name),* }
    };
    (@mirror $file:ident $model:ident { $($name:ident),* }) => {
        impl $crate::input::mirror::Mirror<$model> for $file {
            fn model(&self) -> $model {
                match self { $(Self::$name => $model::$name),* }
            }

            fn of(model: &$model) -> Self {
                match model { $($model::$name => Self::$name),* }
            }
        }
    };
}

/// Whether a part equals the default of a file that leaves it out.
pub(crate) fn says_default<M: Default + PartialEq, T: Mirror<M>>(file: &T) -> bool {
    file.model() == M::default()
}

macro_rules! mirror_self {
    ($($own:ty),*) => {$(
        impl Mirror<$own> for $own {
            fn model(&self) -> $own {
                *self
            }

            fn of(model: &$own) -> Self {
                *model
            }
        }
    )*};
}

pub(crate) use {mirrored, mirrored_choice};
mirror_self!(f64, usize, i32);

impl<M, T: Mirror<M>> Mirror<Option<M>> for Option<T> {
    fn model(&self) -> Option<M> {
        self.as_ref().map(T::model)
    }

    fn of(model: &Option<M>) -> Self {
        model.as_ref().map(T::of)
    }
}

impl<M, T: Mirror<M>> Mirror<Vec<M>> for Vec<T> {
    fn model(&self) -> Vec<M> {
        self.iter().map(T::model).collect()
    }

    fn of(model: &Vec<M>) -> Self {
        model.iter().map(T::of).collect()
    }
}

/// A pair of numbers of one kind.
impl<T: Mirror<f64>> Mirror<[f64; 2]> for (T, T) {
    fn model(&self) -> [f64; 2] {
        [self.0.model(), self.1.model()]
    }

    fn of(model: &[f64; 2]) -> Self {
        (T::of(&model[0]), T::of(&model[1]))
    }
}

/// Whether a face of the spool is bonded.
impl Mirror<Contact> for bool {
    fn model(&self) -> Contact {
        if *self { Contact::Bonded } else { Contact::Gap }
    }

    fn of(model: &Contact) -> Self {
        *model == Contact::Bonded
    }
}
